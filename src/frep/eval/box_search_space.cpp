// Searches over two and three variables; see box_search.h.
#include <algorithm>

#include "frep/eval/box_search_parts.h"

namespace frep::box_search {

namespace {

using math::Interval;

struct Box {
    std::array<Interval, 3> range;
    Slope slope;
    double most = math::infinity;
    std::size_t widest = 0;  ///< the variable to divide
    bool one_peak = false;
    int order = 0;
};

bool comes_later(const Box& p, const Box& q) {
    return p.most < q.most || (p.most == q.most && p.order > q.order);
}

double size(const Interval& a) { return std::max(math::abs(a.lo), math::abs(a.hi)); }

class SpaceSearch {
  public:
    SpaceSearch(SearchedFunction& function, const BoxSearchOptions& options)
        : state_(function, options), n_(options.variables), in_ball_(options.in_ball) {}

    BoxSearchResult run() {
        Box whole;
        for (std::size_t i = 0; i < n_; ++i) whole.range[i] = {0.0, 1.0};
        add(std::move(whole));
        while (!open_.empty() && !state_.closes(open_.front().most) && !state_.spent()) {
            std::pop_heap(open_.begin(), open_.end(), comes_later);
            const Box box = std::move(open_.back());
            open_.pop_back();
            divide(box);
        }
        for (const Box& box : open_) state_.leave(box.most, box.one_peak);
        return state_.result();
    }

  private:
    void divide(const Box& box) {
        const Interval side = box.range[box.widest];
        const double c = middle(side);
        if (!(side.lo < c && c < side.hi)) return state_.leave(box.most, true);  // neighbours among doubles
        for (const Interval& half : {Interval(side.lo, c), Interval(c, side.hi)}) {
            Box part;
            part.range = box.range;
            part.range[box.widest] = half;
            part.most = box.most;
            add(std::move(part));
        }
    }

    void add(Box box) {
        if (in_ball_ && outside_ball(box)) return;
        box.slope = state_.slope({box.range.data(), n_});
        if (box.slope.value.is_empty()) return;
        if (!in_ball_ && fix_variables(box)) box.slope = state_.slope({box.range.data(), n_});
        if (box.slope.value.is_empty()) return;
        bound(box);
        if (box.one_peak && !state_.closes(box.most) && !state_.suffices(box.most))
            box.most = std::min(box.most, bound_concave(state_, {box.range.data(), n_}, in_ball_));
        if (state_.closes(box.most) || (box.one_peak && state_.suffices(box.most)))
            return state_.leave(box.most, box.one_peak);
        box.order = ++made_;
        open_.push_back(std::move(box));
        std::push_heap(open_.begin(), open_.end(), comes_later);
    }

    bool outside_ball(const Box& box) const {
        double nearest = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double d = std::max({box.range[i].lo - 0.5, 0.5 - box.range[i].hi, 0.0});
            nearest += d * d;
        }
        return nearest > 0.25 * (1 + 1e-12);
    }

    /// Variables in which the function rises or falls all over the box stay at the better end.
    bool fix_variables(Box& box) const {
        if (box.slope.value.maybe_undefined) return false;
        bool fixed = false;
        for (std::size_t i = 0; i < n_; ++i) {
            Interval& range = box.range[i];
            if (range.lo == range.hi) continue;
            const Interval& d = box.slope.d[i];
            if (d.lo >= 0) range = Interval(range.hi);
            if (d.hi <= 0) range = Interval(range.lo);
            fixed = fixed || range.lo == range.hi;
        }
        return fixed;
    }

    /// The middle of the box, or, where that is outside of the ball, the last place in it on the way there
    /// from the place of the box that is nearest to the middle of the ball. Always in the box: slopes hold
    /// there alone.
    std::array<Interval, 3> inner_point(const Box& box) const {
        std::array<double, 3> near{}, way{};
        for (std::size_t i = 0; i < n_; ++i) {
            near[i] = std::clamp(0.5, box.range[i].lo, box.range[i].hi);
            way[i] = middle(box.range[i]) - near[i];
        }
        const auto inside = [&](double share) {
            double square = 0;
            for (std::size_t i = 0; i < n_; ++i) {
                const double d = near[i] + share * way[i] - 0.5;
                square += d * d;
            }
            return square <= 0.25;
        };
        double share = 1;
        if (in_ball_ && !inside(1)) {
            double low = 0, high = 1;
            for (int step = 0; step < 50; ++step) {
                const double half = 0.5 * (low + high);
                (inside(half) ? low : high) = half;
            }
            share = low;
        }
        std::array<Interval, 3> at;
        for (std::size_t i = 0; i < n_; ++i)
            at[i] = Interval(std::clamp(near[i] + share * way[i], box.range[i].lo, box.range[i].hi));
        return at;
    }

    /// Bounds the values in the box, and chooses the variable that adds most to the bound.
    void bound(Box& box) {
        const std::array<Interval, 3> at = inner_point(box);
        const SearchPoint point = state_.look({at.data(), n_});
        const Slope& slope = box.slope;
        box.most = std::min(box.most, slope.value.hi);
        box.one_peak = false;
        std::array<double, 3> width{}, share{};
        for (std::size_t i = 0; i < n_; ++i) {
            width[i] = box.range[i].hi - box.range[i].lo;
            const double d = size(slope.d[i]);
            share[i] = width[i] * (d < math::infinity ? d : 1.0);
        }
        const bool even = !slope.value.maybe_undefined && point.defined();
        if (even) {
            const double bend = bend_of(slope);
            box.one_peak = bend == 0;
            if (box.one_peak) share = width;
            box.most = std::min(box.most, linear_bound(box, at, point, slope.d, 0));
            box.most = std::min(box.most, linear_bound(box, at, point, point.slope.d, bend));
        }
        box.widest = static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
        if (!(share[box.widest] > 0))
            box.widest =
                static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
    }

    /// From the value at a point with derivatives in `d`, and what a curvature of up to `bend` adds.
    double linear_bound(const Box& box, const std::array<Interval, 3>& at, const SearchPoint& point,
                        const std::array<Interval, 3>& d, double bend) const {
        Interval within_box(0.0), curved(0.0), spread(0.0), square(0.0);
        for (std::size_t i = 0; i < n_; ++i) {
            if (!(size(d[i]) < math::infinity)) return math::infinity;
            const Interval step = box.range[i] - at[i];
            within_box = within_box + Interval((d[i] * step).hi);
            curved = curved + math::square(Interval(size(step)));
            const Interval g(middle(d[i]));
            spread = spread + Interval(size(d[i] - g)) * Interval(size(step));
            square = square + math::square(g);
        }
        double most = within_box.hi;
        if (in_ball_) {
            const double in_ball = over_ball(box, at, d, math::sqrt(square).hi);
            most = std::min(most, (spread + Interval(in_ball)).hi);
        }
        const Interval bent = Interval(0.5) * Interval(bend) * curved;
        return (Interval(point.most()) + Interval(most) + bent).hi;
    }

    /// The most of g . (t - at) over what the box and the ball have in common, g = the middle of d: at most
    /// that of g . (t - at) - k (|t - 1/2|^2 - 1/4) over the box, for every k >= 0. With k = |g| they meet
    /// where the box holds the best place of the ball.
    double over_ball(const Box& box, const std::array<Interval, 3>& at, const std::array<Interval, 3>& d,
                     double k) const {
        Interval sum = Interval(0.25) * Interval(k);
        for (std::size_t i = 0; i < n_; ++i) {
            const double g = middle(d[i]);
            const double best = k > 0 ? std::clamp(0.5 + 0.5 * g / k, box.range[i].lo, box.range[i].hi) : 0.5;
            const Interval t(best);
            sum = sum + Interval(g) * (t - at[i]) - Interval(k) * math::square(t - Interval(0.5));
        }
        return sum.hi + 1e-14 * k;
    }

    SearchState state_;
    std::size_t n_;
    bool in_ball_;
    std::vector<Box> open_;  ///< heap
    int made_ = 0;
};

}  // namespace

BoxSearchResult search_space(SearchedFunction& function, const BoxSearchOptions& options) {
    return SpaceSearch(function, options).run();
}

}  // namespace frep::box_search
