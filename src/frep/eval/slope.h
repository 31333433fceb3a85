// Slopes: an interval of values over a box of up to three variables, with enclosures of the derivatives and
// of the curvature there. Forward mode, a rule an operation; what has no rule is "anything". Kinks are
// covered: at them the derivatives are those of both sides (F. H. Clarke, Optimization and Nonsmooth
// Analysis, 1983), and a kink upwards or downwards is an infinite curvature of that sign. Used by the search
// for largest values (box_search.h). Tested by tests/unit/eval/box_search_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "frep/field/graph.h"
#include "frep/math/interval.h"

namespace frep {

/// What is known of a function f of n variables over a box.
struct Slope {
    math::Interval value;
    /// Holds (f(q) - f(p)) / |q - p| along each axis wherever f is defined in the whole box; the flags of
    /// these intervals mean nothing. Not used beyond n.
    std::array<math::Interval, 3> d;
    /// Holds v'Hv for all unit vectors v, H = the matrix of second derivatives: upper bound <= 0 means
    /// concave, kinks included. At a single point nobody asks.
    math::Interval curvature;
    bool fixed = true;  ///< does not change with the variables: d and curvature are 0

    /// Nothing is known but the value.
    static Slope of_value(const math::Interval& value) {
        const auto any = math::Interval::entire();
        return {value, {any, any, any}, any, false};
    }
    /// Does not change with the variables.
    static Slope constant(const math::Interval& value) { return {value, {}, {}, true}; }
    /// Variable number `index` over a range.
    static Slope variable(const math::Interval& range, std::size_t index) {
        Slope out{range, {}, {}, false};
        out.d[index] = math::Interval(1.0);
        return out;
    }
};

/// `op` on slopes of functions of `variables` variables (1 to 3); `block` are its data, as in meaning().
/// Without `curved` the curvature is not computed and means nothing.
Slope slope_of(Op op, std::span<const Slope* const> arguments, std::span<const double> block,
               std::size_t variables, bool curved = true);

/// a + b + r - hypot(a - b, r): twice the smaller of a and b, rounded where they are near one another.
struct RoundedMinimum {
    NodeId a = 0, b = 0, r = 0;
};

/// The parts of such a node, which is a subtraction.
std::optional<RoundedMinimum> rounded_minimum(const Graph& graph, NodeId id);

/// What rounded_minimum() found, as one operation: it rises with a and b and is concave where they are, which
/// the rules of its parts do not show. Nothing where r changes or may be 0, or where a or b may be undefined
/// or infinite.
std::optional<Slope> rounded_minimum_slope(const Slope& a, const Slope& b, const Slope& r,
                                           std::size_t variables, bool curved);

}  // namespace frep
