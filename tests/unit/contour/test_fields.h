// Fields written as plain C++ functions, for the tests of contour: values, gradients by
// differences, and intervals where the test gives them.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/math/interval.h"

namespace frep::test {

using Interval = math::Interval;

/// F = f(x, y, z); `range` gives an enclosure, or nothing is known about boxes.
class FunctionField final : public SampledField {
  public:
    using Value = std::function<double(double, double, double)>;
    using Range = std::function<Interval(Interval, Interval, Interval)>;

    explicit FunctionField(Value value, Range range = nullptr)
        : value_(std::move(value)), range_(std::move(range)) {}

    std::unique_ptr<SampledField> clone() const override { return std::make_unique<FunctionField>(*this); }

    void values(const PointSpans& p, std::span<double> out) override {
        for (std::size_t i = 0; i < p.size(); ++i) out[i] = value_(p.x[i], p.y[i], p.z[i]);
    }

    void gradients(const PointSpans& p, std::span<double> values, const GradientSpans& out) override {
        constexpr double d = 1e-6;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double x = p.x[i], y = p.y[i], z = p.z[i];
            values[i] = value_(x, y, z);
            out.x[i] = slope(values[i], value_(x - d, y, z), value_(x + d, y, z), d);
            out.y[i] = slope(values[i], value_(x, y - d, z), value_(x, y + d, z), d);
            out.z[i] = slope(values[i], value_(x, y, z - d), value_(x, y, z + d), d);
        }
    }

    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            out[i] = {};
            if (!range_) continue;
            const Box3& b = boxes[i];
            const Interval f = range_({b.min.x, b.max.x}, {b.min.y, b.max.y}, {b.min.z, b.max.z});
            out[i] = {!f.is_empty() && f.hi >= 0, !f.is_empty() && f.lo < 0, f.maybe_undefined};
        }
    }

    double operator()(double x, double y, double z) const { return value_(x, y, z); }

  private:
    /// Central difference, or from one side where the other is undefined.
    static double slope(double here, double below, double above, double d) {
        if (above != above) return (here - below) / d;
        if (below != below) return (above - here) / d;
        return (above - below) / (2 * d);
    }

    Value value_;
    Range range_;
};

/// A field from one generic function of three numbers (double or Interval).
template <class F>
FunctionField generic_field(F f) {
    return FunctionField([f](double x, double y, double z) { return f(x, y, z); },
                         [f](Interval x, Interval y, Interval z) { return f(x, y, z); });
}

inline auto sphere_function(double radius, double cx = 0, double cy = 0, double cz = 0) {
    return [=](auto x, auto y, auto z) {
        using math::square;
        return radius * radius - square(x - cx) - square(y - cy) - square(z - cz);
    };
}

inline auto torus_function(double ring, double tube) {
    return [=](auto x, auto y, auto z) {
        using math::sqrt;
        using math::square;
        return tube * tube - square(sqrt(square(x) + square(y)) - ring) - square(z);
    };
}

/// A number in [-1, 1) that depends on the arguments only (a mix of 64-bit multiplications).
inline double noise(std::uint64_t seed, std::uint64_t i) {
    std::uint64_t h = (seed * 0x9e3779b97f4a7c15u) ^ (i * 0xbf58476d1ce4e5b9u + 0x94d049bb133111ebu);
    h ^= h >> 31;
    h *= 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace frep::test
