// Implementation of edge_roots.h.
#include "frep/contour/edge_roots.h"

namespace frep::contouring {

namespace {

constexpr int most_steps = 46;    // bisection needs 40 to reach root_width
constexpr int rounds = 3;         // of bisections, each
constexpr std::size_t parts = 8;  // into so many parts at once
// The largest value where a guess has its root, by the smaller one at the ends of the bracket.
constexpr double first_trust = 0.03;   // of the model or the secant of an edge
constexpr double second_trust = 1e-4;  // of the next step
constexpr double part_trust = 0.06;    // of the secant of a part
constexpr double end_trust = 1e-11;    // added, by both ends: crossings at an end
constexpr double secant_shift = 0.1;   // towards the middle, times the squared way to the nearer end
constexpr double least_shift = 0.3 * root_width;

bool is_finite(double v) { return v - v == 0; }

double magnitude(double v) { return v < 0 ? -v : v; }

/// Whether `value`, where a guess has its root, is as small as it is if the guess follows F.
bool is_as_guessed(double value, double low_value, double high_value, double trust) {
    const double low = magnitude(low_value), high = magnitude(high_value);
    return magnitude(value) <= trust * (low < high ? low : high) + end_trust * (low + high);
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
    // Where it turns, a cubic with three roots on the edge goes against the ends.
    if ((s0 < 0) != (s1 < 0) && !(slope(s0 / (s0 - s1)) / (f1 - f0) > 0)) return;
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
        if (step > 1 && moved > shift) shift = moved;
    }
    const double to_middle = middle - estimate, distance = to_middle < 0 ? -to_middle : to_middle;
    const double sign = to_middle < 0 ? -1 : 1;
    const double tried = shift <= distance ? estimate + sign * shift : middle;
    if (step < 2) return tried;  // the bound below is wider than the edge
    const double reach =
        0.5 * root_width * static_cast<double>(std::uint64_t{1} << (most_steps - 1 - step)) - 0.5 * width;
    const double off = middle - tried;
    if ((off < 0 ? -off : off) <= reach) return tried;
    return reach > 0 ? middle - sign * reach : middle;
}

EdgeRoots::Bracket EdgeRoots::whole(const CrossedEdge& edge) {
    return {0, 1, edge.lower_value, edge.upper_value, edge.lower_value, edge.upper_value};
}

void EdgeRoots::evaluate(SampledField& field, std::size_t count) {
    const auto first = [count](std::vector<double>& column) {
        return std::span<double>(column.data(), count);
    };
    field.values({first(x_), first(y_), first(z_)}, first(values_));
}

/// Step `step` of all active edges. The first two also find those that are doubtful.
void EdgeRoots::advance(SampledField& field, const std::vector<CrossedEdge>& edges, int step) {
    const std::size_t count = active_.size();
    for (std::size_t k = 0; k < count; ++k) {
        const CrossedEdge& edge = edges[active_[k]];
        set_point(k, edge, next_try(brackets_[active_[k]], edge.model, values_[k], step));
    }
    evaluate(field, count);
    const double trust = step == 0 ? first_trust : second_trust;
    std::size_t left = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t i = active_[k];
        Bracket& b = brackets_[i];
        if (step < 2 && !is_as_guessed(values_[k], edges[i].lower_value, edges[i].upper_value, trust)) {
            b = whole(edges[i]);
            doubtful_.push_back(i);
            continue;
        }
        b.move_end(t_[k], values_[k]);
        if (!(b.high - b.low > root_width)) continue;
        values_[left] = values_[k];  // the latest value of the edge
        active_[left++] = i;
    }
    active_.resize(left);
}

/// Bisects the doubtful edges by their signs, three times, and again while values do not follow a secant.
/// They become active.
void EdgeRoots::bisect(SampledField& field, const std::vector<CrossedEdge>& edges) {
    for (int round = 1; !doubtful_.empty(); ++round) {
        const std::size_t count = doubtful_.size(), inner = parts - 1;
        for (std::vector<double>* column : {&x_, &y_, &z_, &t_, &values_})
            if (column->size() < count * inner) column->resize(count * inner);
        for (std::size_t k = 0; k < count; ++k) {
            const Bracket& b = brackets_[doubtful_[k]];
            for (std::size_t j = 0; j < inner; ++j) {
                const double share = static_cast<double>(j + 1) / parts;
                set_point(k * inner + j, edges[doubtful_[k]], b.low + (b.high - b.low) * share);
            }
        }
        evaluate(field, count * inner);
        for (std::size_t k = 0; k < count; ++k) {
            Bracket& b = brackets_[doubtful_[k]];
            for (std::size_t half = parts / 2, at = half; half > 0; half /= 2) {
                const std::size_t p = k * inner + at - 1;
                const bool is_low = (values_[p] >= 0) == (b.low_value >= 0);
                (is_low ? b.low : b.high) = t_[p];
                (is_low ? b.low_value : b.high_value) = values_[p];
                at = is_low ? at + half / 2 : at - half / 2;
            }
            b.low_weight = b.low_value;
            b.high_weight = b.high_value;
        }
        if (round == rounds) {
            active_.insert(active_.end(), doubtful_.begin(), doubtful_.end());
            return;
        }
        for (std::size_t k = 0; k < count; ++k) {
            const Bracket& b = brackets_[doubtful_[k]];
            const double t = b.low + (b.high - b.low) * (b.low_value / (b.low_value - b.high_value));
            const bool is_within = t > b.low && t < b.high;
            set_point(k, edges[doubtful_[k]], is_within ? t : b.low + 0.5 * (b.high - b.low));
        }
        evaluate(field, count);
        std::size_t left = 0;
        for (std::size_t k = 0; k < count; ++k) {
            Bracket& b = brackets_[doubtful_[k]];
            if (is_as_guessed(values_[k], b.low_value, b.high_value, part_trust)) {
                b.move_end(t_[k], values_[k]);
                active_.push_back(doubtful_[k]);
            } else {
                doubtful_[left++] = doubtful_[k];
            }
        }
        doubtful_.resize(left);
    }
}

void EdgeRoots::find(SampledField& field, const std::vector<CrossedEdge>& edges,
                     std::vector<EdgeRoot>& roots) {
    brackets_.resize(edges.size());
    active_.resize(edges.size());
    doubtful_.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
        brackets_[i] = whole(edges[i]);
        active_[i] = static_cast<std::uint32_t>(i);
    }
    for (std::vector<double>* column : {&x_, &y_, &z_, &t_, &values_}) column->resize(edges.size());
    for (int step = 0; step < most_steps && !(active_.empty() && doubtful_.empty()); ++step) {
        if (step == 2) bisect(field, edges);
        advance(field, edges, step);
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
