// Implementation of solid_picture.h.
#include "frep/trace/solid_picture.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/trace/painter.h"

namespace frep {

namespace {

Error wrong(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }
bool is_finite(double v) { return v - v == 0; }

/// Cells along the longest side of the object: one for every six pixels, more for light than for small
/// pictures.
int cells_of(const SceneOptions& options) {
    const int wanted = options.longest_side / 6;
    switch (options.quality) {
        case PictureQuality::draft:
            return std::clamp(wanted, 64, 96);
        case PictureQuality::normal:
            return std::clamp(wanted, 96, 192);
        case PictureQuality::high:
            break;
    }
    return std::clamp(wanted, 192, 288);
}

/// The box that the section leaves.
Result<Box3> clipped(const SceneOptions& options) {
    Box3 box = options.bounds;
    const Vec3 side = box.max - box.min;
    if (!(side.x > 0 && side.y > 0 && side.z > 0) || !is_finite(box.diagonal()))
        return wrong("the box of a picture must have a volume");
    if (!options.section) return box;
    const Section& s = *options.section;
    if (s.axis < 0 || s.axis > 2) return wrong("a section has an axis x, y or z");
    double Vec3::*const axes[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
    double Vec3::*const axis = axes[s.axis];
    if (!(s.value > box.min.*axis && s.value < box.max.*axis))
        return wrong(fmt::format("the section {}={} lies outside of the box, {}..{}", "xyz"[s.axis], s.value,
                                 box.min.*axis, box.max.*axis));
    Vec3& end = s.keeps_less ? box.max : box.min;
    end.*axis = s.value;
    return box;
}

tracing::HitSearch search_of(const SampledField& field, PictureQuality quality, bool is_undecided) {
    using tracing::HitSearch;
    if (is_undecided) return HitSearch::samples;
    if (!field.has_dear_ranges()) return HitSearch::proofs;
    if (quality == PictureQuality::draft) return HitSearch::samples;
    return field.can_be_narrowed() ? HitSearch::proofs : HitSearch::close_samples;
}

Status check(const PictureOptions& options) {
    constexpr int most = PictureOptions::most_side;
    if (options.width < 1 || options.height < 1 || options.width > most || options.height > most)
        return wrong(fmt::format("a picture has 1 to {} pixels a side", most));
    if (std::int64_t{options.width} * options.height > PictureOptions::most_pixels)
        return wrong(fmt::format("a picture has at most {} pixels", PictureOptions::most_pixels));
    const View& v = options.view;
    if (!is_finite(v.azimuth) || !(v.elevation >= -90 && v.elevation <= 90))
        return wrong("a view has a finite azimuth and an elevation of -90..90 degrees");
    if (!(v.field_of_view >= 0 && v.field_of_view <= 120))
        return wrong("the field of view is 0..120 degrees");
    if (!(v.zoom >= 0.01 && v.zoom <= 1000)) return wrong("the zoom is 0.01..1000");
    return {};
}

}  // namespace

Section section_towards(const View& view, int axis, double value) {
    const Vec3 forward = tracing::view_frame(view).forward;
    const double along = axis == 0 ? forward.x : axis == 1 ? forward.y : forward.z;
    return {axis, value, along < 0};
}

struct SolidScene::Parts {
    SceneOptions options;
    std::unique_ptr<SampledField> field;
    std::unique_ptr<FieldPool> pool;
    tracing::DistanceGrid grid;
    tracing::HitSearch how = tracing::HitSearch::samples;
};

SolidScene::SolidScene(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidScene::SolidScene(SolidScene&&) noexcept = default;
SolidScene::~SolidScene() = default;

Result<SolidScene> SolidScene::make(const SampledField& field, const SceneOptions& options, const Job& job) {
    const auto clip = clipped(options);
    if (!clip) return clip.error();
    auto parts = std::make_unique<Parts>();
    parts->options = options;
    parts->field = field.clone();
    parts->pool = std::make_unique<FieldPool>(*parts->field);
    auto grid = tracing::DistanceGrid::make(*parts->pool, *clip, cells_of(options), job);
    if (!grid) return grid.error();
    parts->grid = std::move(*grid);
    parts->how = search_of(*parts->field, options.quality, parts->grid.sampled());
    return SolidScene(std::move(parts));
}

bool SolidScene::has_solid() const { return parts_->grid.has_solid(); }
bool SolidScene::sampled() const { return parts_->how == tracing::HitSearch::samples; }

Result<Image> SolidScene::picture(const PictureOptions& options, const Job& job) const {
    if (const Status status = check(options); !status) return status.error();
    tracing::Painter painter(parts_->grid, *parts_->pool, parts_->options, options, parts_->how);
    return painter.paint(job);
}

Result<Image> render_solid(const SampledField& field, const SceneOptions& scene,
                           const PictureOptions& options, const Job& job) {
    const auto made = SolidScene::make(field, scene, job);
    if (!made) return made.error();
    return made->picture(options, job);
}

}  // namespace frep
