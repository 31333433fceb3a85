// The largest value of a concave function over a box, or the part of it in the ball: the ellipsoid method
// with deep cuts (N. Z. Shor, 1977; R. G. Bland, D. Goldfarb, M. J. Todd, Operations Research 29, 1981). The
// maximum lies in an ellipsoid, which each look at a point cuts; what the tangent plane at the point allows
// in it bounds the maximum.
#include <algorithm>

#include "frep/eval/box_search_parts.h"

namespace frep::box_search {

namespace {

using math::Interval;
using Vector = std::array<double, 3>;

class ConcaveSearch {
  public:
    ConcaveSearch(SearchState& state, std::span<const Interval> box, bool in_ball)
        : state_(state), box_(box), in_ball_(in_ball) {
        for (std::size_t i = 0; i < box.size(); ++i) {
            x_[i] = middle(box[i]);
            if (box[i].lo < box[i].hi) active_.push_back(i);
        }
        const double n = static_cast<double>(active_.size());
        for (const std::size_t i : active_) {
            const double half = std::max(box[i].hi - x_[i], x_[i] - box[i].lo);
            shape_[i][i] = n * half * half * (1 + 1e-9);
            if (in_ball && shape_[i][i] > 0.25) shape_[i][i] = 0.25 * (1 + 1e-9);
        }
    }

    /// A bound of the values in the box.
    double run() {
        const int calls = 64 * static_cast<int>(active_.size());
        for (int k = 0; k < calls && !state_.closes(most_) && !state_.suffices(most_) && !state_.spent(); ++k)
            if (!step()) break;
        return most_;
    }

  private:
    bool step() {
        const Vector c = nearest_inside();
        std::array<Interval, 3> at;
        for (std::size_t i = 0; i < box_.size(); ++i) at[i] = Interval(c[i]);
        const SearchPoint point = state_.look({at.data(), box_.size()});
        if (!point.defined()) return false;
        Vector g{};
        double spread = 0, lift = 0;
        for (const std::size_t i : active_) {
            g[i] = middle(point.slope.d[i]);
            if (!(math::abs(g[i]) < math::infinity)) return false;
            // How far the derivative may be from g, over the box.
            spread += (point.slope.d[i].hi - g[i]) * (box_[i].hi - box_[i].lo);
            lift += g[i] * (x_[i] - c[i]);
        }
        const double s = reach(g);
        const double top = point.most() + spread;
        // Roundings are far below the places that these numbers are raised by.
        const double raise = 1e-14 * (math::abs(top) + math::abs(lift) + s);
        most_ = std::min({most_, top + lift + s + raise, top + over_box(g, c) + raise,
                          in_ball_ ? top + over_ball(g, c) + raise : math::infinity});
        if (cut_to_inside()) return true;
        if (!(s > spread)) return false;
        return cut(g, (state_.least() - top - lift) / s);
    }

    /// The place of the box, or of the ball, that is near to the middle of the ellipsoid.
    Vector nearest_inside() const {
        Vector c = x_;
        double square = 0;
        for (std::size_t i = 0; i < box_.size(); ++i) {
            if (!in_ball_) c[i] = std::clamp(c[i], box_[i].lo, box_[i].hi);
            square += (c[i] - 0.5) * (c[i] - 0.5);
        }
        if (in_ball_ && square > 0.25) {
            const double shrink = 0.5 / math::sqrt(square) * (1 - 0x1p-50);
            for (std::size_t i = 0; i < box_.size(); ++i) c[i] = 0.5 + (c[i] - 0.5) * shrink;
        }
        return c;
    }

    /// The most of g . (t - c) over the box and over the ball.
    double over_box(const Vector& g, const Vector& c) const {
        double sum = 0;
        for (const std::size_t i : active_)
            sum += std::max(g[i] * (box_[i].lo - c[i]), g[i] * (box_[i].hi - c[i]));
        return sum;
    }
    double over_ball(const Vector& g, const Vector& c) const {
        double square = 0, sum = 0;
        for (const std::size_t i : active_) {
            square += g[i] * g[i];
            sum += g[i] * (0.5 - c[i]);
        }
        return sum + 0.5 * math::sqrt(square);
    }
    /// The most of g . (t - x) over the ellipsoid.
    double reach(const Vector& g) const {
        double sum = 0;
        for (const std::size_t i : active_)
            for (const std::size_t k : active_) sum += g[i] * shape_[i][k] * g[k];
        return math::sqrt(std::max(sum, 0.0));
    }

    /// Cuts off what is outside of the box or the ball; false when the middle is inside.
    bool cut_to_inside() {
        if (in_ball_) {
            Vector u{};
            double square = 0;
            for (const std::size_t i : active_) square += (x_[i] - 0.5) * (x_[i] - 0.5);
            const double distance = math::sqrt(square);
            if (!(distance > 0.5)) return false;
            for (const std::size_t i : active_) u[i] = (0.5 - x_[i]) / distance;
            return cut(u, (distance - 0.5) / reach(u));
        }
        for (const std::size_t i : active_) {
            Vector u{};
            u[i] = x_[i] > box_[i].hi ? -1.0 : 1.0;
            const double outside = std::max(x_[i] - box_[i].hi, box_[i].lo - x_[i]);
            if (outside > 0) return cut(u, outside / reach(u));
        }
        return false;
    }

    /// Keeps u . (t - x) >= depth * reach(u). False when that helps no more.
    bool cut(const Vector& u, double depth) {
        const double n = static_cast<double>(active_.size()), s = reach(u);
        depth = std::min(depth, 1 - 1e-6);
        if (!(s > 0) || !(depth > -0.9 / n)) return false;
        Vector b{};
        for (const std::size_t i : active_)
            for (const std::size_t k : active_) b[i] += shape_[i][k] * u[k] / s;
        const double move = (1 + n * depth) / (n + 1);
        const double shrink = active_.size() == 1 ? 0.25 * (1 - depth) * (1 - depth)
                                                  : n * n * (1 - depth * depth) / (n * n - 1);
        const double flatten = active_.size() == 1 ? 0.0 : 2 * move / (1 + depth);
        // The entries cancel when the ellipsoid is thin: what rounding may have taken, of the longest axis,
        // is added all round.
        double slack = 0;
        for (const std::size_t i : active_) slack += shape_[i][i];
        slack *= 1e-14 * shrink;
        for (const std::size_t i : active_) {
            x_[i] += move * b[i];
            for (const std::size_t k : active_)
                shape_[i][k] = shrink * (shape_[i][k] - flatten * b[i] * b[k]) * (1 + 1e-10);
            shape_[i][i] += slack;
        }
        return true;
    }

    SearchState& state_;
    std::span<const Interval> box_;
    bool in_ball_;
    std::vector<std::size_t> active_;  ///< variables with a range
    Vector x_{};                       ///< middle of the ellipsoid (t - x)' shape^-1 (t - x) <= 1
    std::array<Vector, 3> shape_{};
    double most_ = math::infinity;
};

}  // namespace

double bound_concave(SearchState& state, std::span<const Interval> box, bool in_ball) {
    return ConcaveSearch(state, box, in_ball).run();
}

}  // namespace frep::box_search
