// Searches over one variable, and what all searches share; see box_search.h.
#include "frep/eval/box_search.h"

#include <algorithm>

#include "frep/eval/box_search_parts.h"

namespace frep {

namespace box_search {

using math::Interval;

namespace {

/// A part of the range with what is known at its ends.
struct Part {
    double a = 0, b = 1;
    SearchPoint at_a, at_b;
    Slope slope;                   ///< over the part, or over one that holds it
    bool own_slope = true;         ///< of this part
    int lopsided = 0;              ///< divisions that left more than half, one after the other
    double most = math::infinity;  ///< no value in the part is larger
    int order = 0;                 ///< of making, to settle ties
};

/// True for the part to be looked at later.
bool comes_later(const Part& p, const Part& q) {
    return p.most < q.most || (p.most == q.most && p.order > q.order);
}

class LineSearch {
  public:
    LineSearch(SearchedFunction& function, const BoxSearchOptions& options) : state_(function, options) {}

    BoxSearchResult run() {
        Part whole;
        whole.at_a = look(0.0);
        whole.at_b = look(1.0);
        const Interval range(0.0, 1.0);
        whole.slope = state_.slope({&range, 1});
        add(std::move(whole));
        while (!open_.empty() && !state_.closes(open_.front().most) && !state_.spent()) {
            std::pop_heap(open_.begin(), open_.end(), comes_later);
            const Part part = std::move(open_.back());
            open_.pop_back();
            if (part.own_slope)
                divide(part);
            else
                refine(part);
        }
        for (const Part& part : open_) state_.leave(part.most, keeps_one_peak(part));
        return state_.result();
    }

  private:
    SearchPoint look(double t) {
        const Interval at(t);
        return state_.look({&at, 1});
    }

    /// The slope above the line from a to the right, and from b to the left.
    struct Lines {
        bool known = false;
        double right = 0, left = 0;
    };
    static Lines lines(const Part& part) {
        if (part.slope.value.maybe_undefined || !part.at_a.defined() || !part.at_b.defined()) return {};
        const double bend = up(0.5 * bend_of(part.slope) * (part.b - part.a));
        return {true, std::min(part.slope.d[0].hi, up(part.at_a.slope.d[0].hi + bend)),
                std::max(part.slope.d[0].lo, -up(bend - part.at_b.slope.d[0].lo))};
    }
    static double up(double x) { return math::next_up(x); }

    /// Where the lines from both ends meet, as a distance from a.
    static double meeting(const Part& part, const Lines& l) {
        const double width = part.b - part.a;
        const double rise = part.at_b.most() - part.at_a.most();
        const double s = (rise - l.left * width) / (l.right - l.left);
        return s >= 0 ? std::min(s, width) : 0.0;  // 0 where it is undefined
    }

    static double bound(const Part& part) {
        const double most = part.slope.value.is_empty() ? -math::infinity : part.slope.value.hi;
        const Lines l = lines(part);
        if (!l.known) return most;
        if (l.right <= 0) return std::min(most, part.at_a.most());
        if (l.left >= 0) return std::min(most, part.at_b.most());
        if (!(l.right < math::infinity && l.left > -math::infinity)) return most;
        // Below the place where they meet the left line bounds the values, above it the right one.
        const Interval s(meeting(part, l));
        const Interval from_a = Interval(part.at_a.most()) + Interval(l.right) * s;
        const Interval from_b =
            Interval(part.at_b.most()) + Interval(l.left) * (s - (Interval(part.b) - Interval(part.a)));
        return std::min(most, std::max(from_a.hi, from_b.hi));
    }

    /// True where one look at the derivative tells on which side the largest value is.
    static bool keeps_one_peak(const Part& part) {
        const Lines l = lines(part);
        return l.known && (l.right <= 0 || l.left >= 0 || part.slope.curvature.hi <= flat);
    }

    void add(Part part) {
        part.most = std::min(part.most, bound(part));
        if (part.most == -math::infinity) return;
        const bool one_peak = keeps_one_peak(part);
        if (state_.closes(part.most) || (one_peak && state_.suffices(part.most)))
            return state_.leave(part.most, one_peak);
        part.order = ++made_;
        open_.push_back(std::move(part));
        std::push_heap(open_.begin(), open_.end(), comes_later);
    }

    void refine(Part part) {
        const Interval range(part.a, part.b);
        part.slope = state_.slope({&range, 1});
        part.own_slope = true;
        add(std::move(part));
    }

    /// Where to divide: at the place where the derivative vanishes if it is even, at a kink where the lines
    /// meet, else in the middle.
    static double place(const Part& part) {
        const double width = part.b - part.a, middle = part.a + 0.5 * width;
        const Lines l = lines(part);
        if (!l.known || part.lopsided >= 2) return middle;
        double s = 0.5 * width;
        const double da = part.at_a.slope.d[0].lo, db = part.at_b.slope.d[0].hi;
        const Interval& bend = part.slope.curvature;
        if (bend.lo > -math::infinity && bend.hi < math::infinity && da > 0 && db < 0)
            s = width * (da / (da - db));
        else if (l.right < math::infinity && l.left > -math::infinity)
            s = meeting(part, l);
        constexpr double margin = 1.0 / 32;
        return part.a + std::clamp(s, margin * width, (1 - margin) * width);
    }

    void divide(const Part& part) {
        const double c = place(part);
        // Neighbours among the doubles: their values are known.
        if (!(part.a < c && c < part.b))
            return state_.leave(std::max(part.at_a.most(), part.at_b.most()), true);
        const SearchPoint at_c = look(c);
        Part left = part, right = part;
        left.b = right.a = c;
        left.at_b = right.at_a = at_c;
        for (Part* half : {&left, &right}) {
            half->own_slope = false;
            half->lopsided = half->b - half->a > 0.5 * (part.b - part.a) * (1 + 1e-9) ? part.lopsided + 1 : 0;
            add(std::move(*half));
        }
    }

    SearchState state_;
    std::vector<Part> open_;  ///< heap
    int made_ = 0;
};

}  // namespace

}  // namespace box_search

BoxSearchResult search_box(SearchedFunction& function, const BoxSearchOptions& options) {
    if (options.variables == 1) return box_search::LineSearch(function, options).run();
    return box_search::search_space(function, options);
}

}  // namespace frep
