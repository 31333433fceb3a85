// Implementation of edge_roots.h.
#include "frep/contour/edge_roots.h"

namespace frep::contouring {

namespace {

constexpr int most_steps = 42;        // bisection needs 40 to reach root_width
constexpr double secant_shift = 0.1;  // towards the middle, times the squared way to the nearer end

/// The value that the secant takes for the end that stays where it is, after the other end's value went from
/// `old` to `now`: scaled down, so that the end is soon replaced too (Anderson and Bjorck 1973).
void shrink(double old, double now, double& kept) {
    const double scale = 1 - now / old;
    kept *= scale > 0 && scale <= 1 ? scale : 0.5;
}

/// The next point to try in a bracket after `step` steps.
double next_try(double low, double high, double low_value, double high_value, int step) {
    const double width = high - low, middle = low + 0.5 * width;
    const double secant = low + width * (low_value / (low_value - high_value));
    if (!(secant >= low && secant <= high)) return middle;
    const double to_middle = middle - secant;
    const double distance = to_middle < 0 ? -to_middle : to_middle;
    const double to_low = secant - low, to_high = high - secant;
    const double near = to_low < to_high ? to_low : to_high;
    const double shift = secant_shift * near * near;
    const double least = 0.3 * root_width;
    const double moved = shift > least ? shift : least;
    const double sign = to_middle < 0 ? -1 : 1;
    const double tried = moved <= distance ? secant + sign * moved : middle;
    const double reach =
        0.5 * root_width * static_cast<double>(std::uint64_t{1} << (most_steps - 1 - step)) - 0.5 * width;
    const double off = middle - tried;
    if ((off < 0 ? -off : off) <= reach) return tried;
    return reach > 0 ? middle - sign * reach : middle;
}

}  // namespace

Vec3 point_on(const CrossedEdge& edge, double t) {
    Vec3 p = edge.lower;
    (edge.axis == 0 ? p.x : edge.axis == 1 ? p.y : p.z) += t * edge.length;
    return p;
}

void EdgeRoots::find(SampledField& field, const std::vector<CrossedEdge>& edges,
                     std::vector<EdgeRoot>& roots) {
    brackets_.clear();
    active_.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const double low = edges[i].lower_value, high = edges[i].upper_value;
        brackets_.push_back({0, 1, low, high, low, high});
        active_.push_back(static_cast<std::uint32_t>(i));
    }
    for (std::vector<double>* column : {&x_, &y_, &z_, &t_, &values_}) column->resize(edges.size());
    for (int step = 0; step < most_steps && !active_.empty(); ++step) {
        const std::size_t count = active_.size();
        for (std::size_t k = 0; k < count; ++k) {
            const Bracket& b = brackets_[active_[k]];
            t_[k] = next_try(b.low, b.high, b.low_weight, b.high_weight, step);
            const Vec3 p = point_on(edges[active_[k]], t_[k]);
            x_[k] = p.x;
            y_[k] = p.y;
            z_[k] = p.z;
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
            if (b.high - b.low > root_width) active_[left++] = i;
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
