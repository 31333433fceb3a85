// The largest value of a function over the box [0, 1]^n, n = 1..3, within a tolerance, proved by intervals:
// branch and bound, the part with the largest bound first (E. R. Hansen, Global Optimization Using Interval
// Analysis, 1992). A part's bound is the smallest of the interval of its values and of what its derivatives
// allow from points whose values are known; where the function is concave, the derivatives at the points
// alone. One variable: the slopes from both ends of a part meet above its largest value (as in S. A.
// Piyavskii's method, 1972), and the part is divided there, or where the derivative is expected to vanish.
// Several variables: the bound from the middle; variables in which the function rises or falls are fixed; the
// side that adds most to the bound is halved; in boxes where the function is concave, ellipsoids close in on
// its largest value. The same input takes the same steps everywhere. Tested by
// tests/unit/eval/box_search_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "frep/eval/slope.h"

namespace frep {

/// A function whose largest value is looked for.
class SearchedFunction {
  public:
    virtual ~SearchedFunction() = default;
    /// What the function does over a box of its variables; with single points for ranges, at a point.
    virtual Slope slope(std::span<const math::Interval> box) = 0;
};

struct BoxSearchOptions {
    std::size_t variables = 1;
    double tolerance = 1e-6;  ///< of the value v: tolerance * max(1, |v|)
    bool in_ball = false;     ///< only |t - 1/2| <= 1/2
    /// For functions that stand for many: parts with one peak are left when their bound passes what the
    /// points may have by no more than this share of what the best point leaves open.
    double looseness = 0;
    int limit = 1 << 15;  ///< calls of slope()
};

struct BoxSearchResult {
    std::array<double, 3> place{};  ///< of the best point found
    /// No defined value of the function exceeds `most`, its place included; -inf where it has none. At
    /// `place` it is at least `least`, which is -inf when no point was found where it is surely defined.
    double least = -math::infinity, most = -math::infinity;
    bool finished = false;  ///< most <= least + tolerance, or no defined value at all
    /// For functions that stand for many, one for each point of a region of space: each of them is finished
    /// too, as far as the slopes tell.
    bool settled = false;
    int calls = 0;
};

BoxSearchResult search_box(SearchedFunction& function, const BoxSearchOptions& options);

}  // namespace frep
