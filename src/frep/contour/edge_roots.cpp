// Implementation of edge_roots.h.
#include "frep/contour/edge_roots.h"

#include <array>

namespace frep::contouring {

namespace {

constexpr int most_steps = 46;        // bisection needs 40 to reach root_width
constexpr double secant_shift = 0.1;  // towards the middle, times the squared way to the nearer end
constexpr double least_shift = 0.3 * root_width;

bool is_finite(double v) { return v - v == 0; }

/// The value that the secant takes for the end that stays where it is, after the other end's value went from
/// `old` to `now`: scaled down, so that the end is soon replaced too (Anderson and Bjorck 1973).
void shrink(double old, double now, double& kept) {
    const double scale = 1 - now / old;
    kept *= scale > 0 && scale <= 1 ? scale : 0.5;
}

/// The Newton step from the model's root, where F is `value`. What the model lacks is a multiple of the
/// product of the ways to its samples; the multiple follows from the value.
double corrected(const EdgeModel& model, double tried, double value) {
    const double t = tried;
    double product = t * (1 - t), slope = 1 - 2 * t;
    if (!(product > 1e-6)) return t - value / model.slope;
    if (model.has_before) {
        slope = slope * (1 + t) + product;
        product *= 1 + t;
    }
    if (model.has_after) {
        slope = slope * (2 - t) - product;
        product *= 2 - t;
    }
    return t - value * product / (model.slope * product + (value - model.value) * slope);
}

}  // namespace

void predict(CrossedEdge& edge, double before, double after) {
    const double f0 = edge.lower_value, f1 = edge.upper_value;
    edge.model = {};
    const bool has_before = is_finite(before), has_after = is_finite(after);
    if (!is_finite(f0 - f1) || (!has_before && !has_after)) return;
    // second differences at the ends; a parabola has one
    double s0 = before - 2 * f0 + f1, s1 = f0 - 2 * f1 + after;
    if (!has_before) s0 = s1;
    if (!has_after) s1 = s0;
    const auto value = [&](double t) {
        return (1 - t) * f0 + t * f1 - t * (1 - t) / 6 * ((2 - t) * s0 + (1 + t) * s1);
    };
    const auto slope = [&](double t) {
        return f1 - f0 - ((1 - 2 * t) * ((2 - t) * s0 + (1 + t) * s1) + t * (1 - t) * (s1 - s0)) / 6;
    };
    double t = f0 / (f0 - f1);
    for (int step = 0; step < 2; ++step) t -= value(t) / slope(t);
    if (!(t >= 0 && t <= 1)) return;
    edge.model = {t, value(t), slope(t), has_before, has_after};
}

/// The next point to try in a bracket after `step` steps; `first_value` is F at the first of them.
double EdgeRoots::next_try(const Bracket& b, const EdgeModel& model, double first_value, int step) {
    const double low = b.low, high = b.high, width = high - low, middle = low + 0.5 * width;
    double estimate = -1;
    if (step == 0) estimate = model.root;
    if (step == 1 && model.is_known()) estimate = corrected(model, low > 0 ? low : high, first_value);
    double shift = least_shift;
    if (!(estimate >= low && estimate <= high)) {
        estimate = low + width * (b.low_weight / (b.low_weight - b.high_weight));
        if (!(estimate >= low && estimate <= high)) return middle;
        const double to_low = estimate - low, to_high = high - estimate;
        const double near = to_low < to_high ? to_low : to_high, moved = secant_shift * near * near;
        if (moved > shift) shift = moved;
    }
    const double to_middle = middle - estimate, distance = to_middle < 0 ? -to_middle : to_middle;
    const double sign = to_middle < 0 ? -1 : 1;
    const double tried = shift <= distance ? estimate + sign * shift : middle;
    const double reach =
        0.5 * root_width * static_cast<double>(std::uint64_t{1} << (most_steps - 1 - step)) - 0.5 * width;
    const double off = middle - tried;
    if ((off < 0 ? -off : off) <= reach) return tried;
    return reach > 0 ? middle - sign * reach : middle;
}

void EdgeRoots::find(SampledField& field, const std::vector<CrossedEdge>& edges,
                     std::vector<EdgeRoot>& roots) {
    brackets_.resize(edges.size());
    active_.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const double low = edges[i].lower_value, high = edges[i].upper_value;
        brackets_[i] = {0, 1, low, high, low, high};
        active_[i] = static_cast<std::uint32_t>(i);
    }
    for (std::vector<double>* column : {&x_, &y_, &z_, &t_, &values_}) column->resize(edges.size());
    const std::array<double*, 3> axes{x_.data(), y_.data(), z_.data()};
    for (int step = 0; step < most_steps && !active_.empty(); ++step) {
        const std::size_t count = active_.size();
        for (std::size_t k = 0; k < count; ++k) {
            const CrossedEdge& edge = edges[active_[k]];
            const double t = next_try(brackets_[active_[k]], edge.model, values_[k], step);
            t_[k] = t;
            x_[k] = edge.lower.x;
            y_[k] = edge.lower.y;
            z_[k] = edge.lower.z;
            axes[edge.axis][k] += t * edge.length;
        }
        const auto first = [count](std::vector<double>& column) {
            return std::span<double>(column.data(), count);
        };
        field.values({first(x_), first(y_), first(z_)}, first(values_));
        std::size_t left = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t i = active_[k];
            Bracket& b = brackets_[i];
            if ((values_[k] >= 0) == (b.low_value >= 0)) {
                shrink(b.low_value, values_[k], b.high_weight);
                b.low = t_[k];
                b.low_value = b.low_weight = values_[k];
            } else {
                shrink(b.high_value, values_[k], b.low_weight);
                b.high = t_[k];
                b.high_value = b.high_weight = values_[k];
            }
            if (!(b.high - b.low > root_width)) continue;
            values_[left] = values_[k];  // the latest value of the edge
            active_[left++] = i;
        }
        active_.resize(left);
    }
    roots.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Bracket& b = brackets_[i];
        const bool is_low_inside = b.low_value >= 0;
        const double outside = is_low_inside ? b.high_value : b.low_value;
        roots[i] = {is_low_inside ? b.low : b.high, is_low_inside ? b.high : b.low, outside != outside};
    }
}

}  // namespace frep::contouring
