// Implementation of slices.h: layers in parallel, each on one thread.
#include "frep/contour/slices.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include "frep/base/parallel.h"

namespace frep {

namespace {

constexpr std::size_t bytes_a_point = 64;  // as outline and in the file

struct Layer {
    PlaneContour contour;
    std::optional<Error> error;
};

/// The numbers of the first and the last layer; first > last without any.
struct Range {
    double first = 1, last = 0;
    double count() const { return last - first + 1; }
};

Range layers_in(double low, double high, double thickness) {
    // The middle of layer k is (k - 0.5) thickness.
    return {std::ceil(low / thickness + 0.5), std::floor(high / thickness + 0.5)};
}

}  // namespace

Result<Slicing> slice_layers(const SampledField& field, const SlicingOptions& options, const Job& job) {
    const double thickness = options.thickness;
    if (!(thickness > 0 && thickness - thickness == 0))
        return Error{ErrorKind::invalid_argument, "the thickness of a layer is not a positive number"};
    const Box3& bounds = options.contour.bounds;
    const Range range = layers_in(bounds.min.z, bounds.max.z, thickness);
    if (!(range.count() <= static_cast<double>(max_layers)) || !(std::abs(range.first) < 1e15))
        return Error{ErrorKind::over_limit, "there would be more than a million layers"};
    std::vector<Layer> layers(range.count() > 0 ? static_cast<std::size_t>(range.count()) : 0);
    FieldPool fields(field);
    std::atomic<std::size_t> points{0};
    std::mutex mutex;  // guards done
    std::size_t done = 0;
    parallel_for(job, layers.size(), [&](std::size_t i) {
        if (points > options.contour.memory_limit / bytes_a_point) return;
        PlaneContourOptions one = options.contour;
        one.plane = Plane::across(2, (range.first + static_cast<double>(i) - 0.5) * thickness);
        Job alone;
        alone.threads = 1;
        Result<PlaneContour> result = contour_plane(fields, one, alone);
        if (!result) {
            layers[i].error = result.error();
            return;
        }
        for (const Polyline& line : result->outlines) points += line.points.size();
        layers[i].contour = std::move(*result);
        const std::lock_guard lock(mutex);
        job.report(static_cast<double>(++done) / static_cast<double>(layers.size()));
    });
    if (job.cancelled()) return Error{ErrorKind::cancelled, "slicing was cancelled"};
    if (points > options.contour.memory_limit / bytes_a_point)
        return Error{ErrorKind::over_limit,
                     "the slices would take more memory than the limit; use fewer cells"};
    Slicing result;
    std::size_t filled = 0;  // slices up to the last with an outline
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (layers[i].error) return *layers[i].error;
        PlaneContour& layer = layers[i].contour;
        result.undefined_points += layer.undefined_points;
        if (!result.first_undefined) result.first_undefined = layer.first_undefined;
        for (std::size_t s = 0; s < 6; ++s) result.touches[s] = result.touches[s] || layer.touches[s];
        const bool is_empty = layer.outlines.empty();
        if (is_empty && result.slices.empty()) continue;
        result.slices.push_back(
            {(range.first + static_cast<double>(i)) * thickness, std::move(layer.outlines)});
        if (!is_empty) filled = result.slices.size();
    }
    result.slices.resize(filled);
    return result;
}

}  // namespace frep
