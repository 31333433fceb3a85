// Solids given by expressions, and what tests of their pictures look at.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "frep/eval/sampled_field.h"
#include "frep/field/expression.h"
#include "frep/field/graph.h"
#include "frep/geom/image.h"

namespace frep::test {

inline std::unique_ptr<SampledField> in_space(const Field& field) {
    auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    auto sampled = make_sampled_field(std::move(*evaluator), AxisMap::standard(field.coordinates));
    REQUIRE(sampled);
    return std::move(*sampled);
}

/// body(x, y, z) in space.
template <class Body>
std::unique_ptr<SampledField> solid(Body body) {
    auto graph = std::make_shared<Graph>();
    const Expression x(*graph, graph->coordinate(0)), y(*graph, graph->coordinate(1)),
        z(*graph, graph->coordinate(2));
    Field field;
    field.value = body(x, y, z).id();
    field.graph = graph;
    field.coordinates = 3;
    return in_space(field);
}

/// Another field, without its intervals: they say nothing.
class WithoutIntervals final : public SampledField {
  public:
    explicit WithoutIntervals(std::unique_ptr<SampledField> field) : field_(std::move(field)) {}

    std::unique_ptr<SampledField> clone() const override {
        return std::make_unique<WithoutIntervals>(field_->clone());
    }
    void values(const PointSpans& points, std::span<double> out) override { field_->values(points, out); }
    void gradients(const PointSpans& points, std::span<double> values, const GradientSpans& out) override {
        field_->gradients(points, values, out);
    }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        for (std::size_t b = 0; b < boxes.size(); ++b) out[b] = {};
    }

  private:
    std::unique_ptr<SampledField> field_;
};

/// R, G, B, A of a pixel.
inline const std::uint8_t* pixel(const Image& image, int x, int y) {
    return &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x))];
}

/// R + G + B of a pixel, 0 to 765.
inline int brightness(const Image& image, int x, int y) {
    const std::uint8_t* p = pixel(image, x, y);
    return p[0] + p[1] + p[2];
}

}  // namespace frep::test
