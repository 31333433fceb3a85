// Fields made of a function, for the tests of pictures of the plane.
#pragma once

#include <functional>
#include <memory>

#include "frep/eval/sampled_field.h"

namespace frep::test {

/// A field of a function; knows nothing of intervals unless it is a disk (see below).
class FunctionField : public SampledField {
  public:
    using Function = std::function<double(Vec3)>;
    using Colors = std::function<Vec3(Vec3)>;

    explicit FunctionField(Function function, Colors colors = {})
        : function_(std::move(function)), colors_(std::move(colors)) {}

    std::unique_ptr<SampledField> clone() const override { return std::make_unique<FunctionField>(*this); }
    void values(const PointSpans& points, std::span<double> out) override {
        for (std::size_t p = 0; p < out.size(); ++p)
            out[p] = function_({points.x[p], points.y[p], points.z[p]});
    }
    void gradients(const PointSpans&, std::span<double>, const GradientSpans&) override {}
    std::size_t attribute_count() const override { return colors_ ? 3 : 0; }
    void attributes(const PointSpans& points, std::span<const std::span<double>> out) override {
        for (std::size_t p = 0; p < points.size(); ++p) {
            const Vec3 c = colors_({points.x[p], points.y[p], points.z[p]});
            const double parts[3] = {c.x, c.y, c.z};
            for (std::size_t k = 0; k < out.size(); ++k) out[k][p] = parts[k];
        }
    }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        for (std::size_t b = 0; b < boxes.size(); ++b) out[b] = {};
    }

  private:
    Function function_;
    Colors colors_;
};

/// r^2 - |p - center|^2 in the plane z = 0, with exact sign ranges.
class DiskField final : public FunctionField {
  public:
    DiskField(Vec2 center, double r, Colors colors = {})
        : FunctionField(
              [=](Vec3 p) {
                  const double x = p.x - center.x, y = p.y - center.y;
                  return r * r - x * x - y * y;
              },
              std::move(colors)),
          center_(center),
          r_(r) {}

    std::unique_ptr<SampledField> clone() const override { return std::make_unique<DiskField>(*this); }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        const auto parts = [](double low, double high, double& nearest, double& farthest) {
            farthest = high > -low ? high : -low;
            nearest = low > 0 ? low : high < 0 ? -high : 0;
        };
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            double nx = 0, fx = 0, ny = 0, fy = 0;
            parts(boxes[b].min.x - center_.x, boxes[b].max.x - center_.x, nx, fx);
            parts(boxes[b].min.y - center_.y, boxes[b].max.y - center_.y, ny, fy);
            out[b] = {nx * nx + ny * ny <= r_ * r_, fx * fx + fy * fy > r_ * r_, false};
        }
    }

  private:
    Vec2 center_;
    double r_;
};

}  // namespace frep::test
