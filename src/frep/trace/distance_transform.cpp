// Implementation of distance_transform.h.
#include "frep/trace/distance_transform.h"

#include <vector>

#include "frep/base/parallel.h"

namespace frep::tracing {

namespace {

/// Lower envelope of parabolas along one row.
class Row {
  public:
    explicit Row(std::size_t n) : values_(n), places_(n), bounds_(n + 1) {}

    void transform(float* data, std::size_t stride) {
        const std::size_t n = values_.size();
        std::size_t count = 0;
        for (std::size_t q = 0; q < n; ++q) {
            values_[q] = data[q * stride];
            if (values_[q] < no_seed) add(q, count);
        }
        if (count == 0) return;
        bounds_[count] = 1e30F;
        std::size_t k = 0;
        for (std::size_t p = 0; p < n; ++p) {
            const auto x = static_cast<float>(p);
            while (bounds_[k + 1] < x) ++k;
            const float d = x - static_cast<float>(places_[k]);
            data[p * stride] = d * d + values_[places_[k]];
        }
    }

  private:
    /// Adds the parabola at q, behind those that it hides.
    void add(std::size_t q, std::size_t& count) {
        const auto x = static_cast<float>(q);
        float start = -1e30F;
        while (count > 0) {
            const std::size_t r = places_[count - 1];
            const auto y = static_cast<float>(r);
            start = ((values_[q] + x * x) - (values_[r] + y * y)) / (2 * (x - y));
            if (start > bounds_[count - 1]) break;
            --count;
        }
        if (count == 0) start = -1e30F;
        places_[count] = q;
        bounds_[count] = start;
        ++count;
    }

    std::vector<float> values_;
    std::vector<std::size_t> places_;
    std::vector<float> bounds_;
};

}  // namespace

void distance_transform(std::span<float> values, const std::array<std::size_t, 3>& size, const Job& job) {
    const std::size_t width = size[0], height = size[1], depth = size[2];
    const std::size_t layer = width * height;
    parallel_for(job, depth, [&](std::size_t k) {
        float* first = values.data() + k * layer;
        Row along_x(width), along_y(height);
        for (std::size_t j = 0; j < height; ++j) along_x.transform(first + j * width, 1);
        for (std::size_t i = 0; i < width; ++i) along_y.transform(first + i, width);
    });
    parallel_for(job, height, [&](std::size_t j) {
        Row along_z(depth);
        for (std::size_t i = 0; i < width; ++i) along_z.transform(values.data() + j * width + i, layer);
    });
}

}  // namespace frep::tracing
