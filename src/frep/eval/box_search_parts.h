// What the searches of box_search.h share: points with what is known there, the best value so far, the rule
// that closes a part. Private to box_search*.cpp.
#pragma once

#include <algorithm>
#include <vector>

#include "frep/eval/box_search.h"

namespace frep::box_search {

/// A curvature up to this much counts as none: rounding of sums of zeros.
inline constexpr double flat = 1e-200;

inline double middle(const math::Interval& a) { return a.lo + 0.5 * (a.hi - a.lo); }

/// What is known at a point.
struct SearchPoint {
    Slope slope;
    bool defined() const { return !slope.value.maybe_undefined && !slope.value.is_empty(); }
    double most() const { return slope.value.is_empty() ? -math::infinity : slope.value.hi; }
};

/// The most that a part bends upwards.
inline double bend_of(const Slope& slope) { return slope.curvature.hi <= flat ? 0.0 : slope.curvature.hi; }

class SearchState {
  public:
    SearchState(SearchedFunction& function, const BoxSearchOptions& options)
        : function_(function), options_(options) {
        result_.settled = true;
    }

    Slope slope(std::span<const math::Interval> box) {
        ++result_.calls;
        return function_.slope(box);
    }

    /// A point of the box, which may become the best.
    SearchPoint look(std::span<const math::Interval> at) {
        const SearchPoint point{slope(at)};
        points_most_ = std::max(points_most_, point.most());
        if (point.defined() && (!found_ || point.slope.value.lo > result_.least)) {
            found_ = true;
            result_.least = point.slope.value.lo;
            for (std::size_t i = 0; i < at.size(); ++i) result_.place[i] = at[i].lo;
        }
        return point;
    }

    bool spent() const { return result_.calls >= options_.limit; }
    double tolerance() const { return options_.tolerance * std::max(1.0, math::abs(result_.least)); }

    /// True when a part with no larger value needs no further look: it is within the tolerance, or below what
    /// the points themselves may have, which no division of parts can lower.
    bool closes(double most) const { return found_ && (proves(most) || most <= points_most_); }

    /// True when a part with one peak is bounded well enough for functions that stand for many.
    bool suffices(double most) const {
        return options_.looseness > 0 && found_ &&
               most <= points_most_ + options_.looseness * (points_most_ - result_.least);
    }

    /// A part is not looked at any more. `one_peak`: a search at any single point of space can end there.
    void leave(double most, bool one_peak) {
        left_most_ = std::max(left_most_, most);
        if (!one_peak && !proves(most)) result_.settled = false;
    }

    BoxSearchResult result() const {
        BoxSearchResult out = result_;
        out.most = std::max(left_most_, points_most_);
        out.finished = proves(out.most) || out.most == -math::infinity;
        return out;
    }

    /// The best value so far, -inf without one.
    double least() const { return result_.least; }

  private:
    bool proves(double most) const { return found_ && most <= result_.least + tolerance(); }
    SearchedFunction& function_;
    BoxSearchOptions options_;
    BoxSearchResult result_;
    bool found_ = false;
    double points_most_ = -math::infinity, left_most_ = -math::infinity;
};

/// A bound of the values of a function that is concave and defined in the box, or in the part of it that lies
/// in the ball: near the largest one where that is found, which `state` then has.
double bound_concave(SearchState& state, std::span<const math::Interval> box, bool in_ball);

/// Searches over two and three variables (box_search_space.cpp).
BoxSearchResult search_space(SearchedFunction& function, const BoxSearchOptions& options);

}  // namespace frep::box_search
