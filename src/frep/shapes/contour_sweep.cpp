// Implementation of contour_sweep.h. A piece of the path lies between two planes. For a point between them
// the share r of the way, from the distances to both planes, gives the place p(s) on the path; the axes there
// give the coordinates of the contour. A point beyond them has its distance from the piece for a bound, so
// that the largest value over all pieces is that of the piece between whose planes the point lies.
#include "frep/shapes/contour_sweep.h"

#include <vector>

#include "frep/math/functions.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/path.h"
#include "frep/shapes/searching.h"

namespace frep::shapes {

namespace {

/// Coordinates of the path beyond this are refused: their squares are no numbers.
constexpr double far_away = 1e100;
/// Coefficients of unit vectors below this are rounding.
constexpr double nothing = 1e-13;

/// The sum of coefficient * value without the terms that are 0.
Expression weighted(Build& build, const std::array<Expression, 3>& values, Vec3 weights) {
    std::optional<Expression> sum;
    const double w[] = {weights.x, weights.y, weights.z};
    for (std::size_t i = 0; i < 3; ++i) {
        if (math::abs(w[i]) < nothing) continue;
        const Expression term = w[i] == 1 ? values[i] : w[i] * values[i];
        sum = sum ? *sum + term : term;
    }
    return sum ? *sum : build.constant(0.0);
}

/// c0 + s (c1 + ...), without the terms that are 0 at the end.
Expression polynomial(Build& build, Expression s, std::span<const double> c) {
    std::optional<Expression> value;
    for (std::size_t i = c.size(); i-- > 0;) {
        if (!value && i > 0 && math::abs(c[i]) < nothing) continue;
        const double known = math::abs(c[i]) < nothing ? 0.0 : c[i];
        value = value ? (known == 0 ? s * *value : known + s * *value) : build.constant(known);
    }
    return *value;
}

/// One polynomial for each coordinate.
template <std::size_t n>
std::array<Expression, 3> polynomials(Build& build, Expression s, const std::array<Vec3, n>& c) {
    std::array<double, n> x, y, z;
    for (std::size_t i = 0; i < n; ++i) x[i] = c[i].x, y[i] = c[i].y, z[i] = c[i].z;
    return {polynomial(build, s, x), polynomial(build, s, y), polynomial(build, s, z)};
}

class ContourSweep {
  public:
    ContourSweep(Build& build, Array x, Expression f, const Path& path)
        : build_(build), x_(x), f_(f), path_(path), point_{x[0], x[1], x[2]} {}

    /// Nothing when f is no function of the items of x.
    std::optional<Expression> value() {
        std::optional<Expression> all;
        for (const PathPiece& piece : path_.pieces) {
            if (build_.graph.over_limit()) return build_.constant(0.0);
            const auto part = value(piece);
            if (!part) return std::nullopt;
            all = all ? max(*all, *part) : *part;
        }
        return all;
    }

  private:
    /// The distance before the knot's plane, negative behind it.
    Expression ahead(const PathKnot& knot) {
        return weighted(build_, point_, knot.normal) - dot(knot.normal, knot.point);
    }

    std::optional<Expression> value(const PathPiece& piece) {
        const Expression from = ahead(path_.knots[piece.first_knot]);
        const Expression to = ahead(path_.knots[piece.last_knot]);
        const Expression a = piece.slant[0] * max(from, 0.0), b = piece.slant[1] * max(-to, 0.0);
        // Where both are 0, on the line in which the planes meet, the share is 0. The bound is no rounding
        // error of ranges in single precision.
        const Expression r = min(a / max(a + b, 1e-6 * piece.length), 1.0);
        const Expression s = piece.bend == 0 ? r : r + piece.bend * r * (1.0 - r);
        const Expression along = piece.start + piece.length * r;

        const auto [side, up] = in_section(piece, s);
        const Expression local[] = {side, up, along / path_.length};
        const auto f = moved(build_, f_, x_, local);
        if (!f) return std::nullopt;
        const Expression inside = path_.closed ? *f : min(*f, min(along, path_.length - along));
        // The same planes with the other sign belong to the neighbours: no point is beyond both.
        const Expression beyond = max(-from, to);
        return select(less(build_.constant(0.0), beyond), min(*f, -beyond), inside);
    }

    /// The coordinates of the contour.
    std::pair<Expression, Expression> in_section(const PathPiece& piece, Expression s) {
        const auto& [side, up] = piece.axes;
        if (piece.straight) {
            const Vec3 p = piece.curve[0];
            return {weighted(build_, point_, side[0]) - dot(side[0], p),
                    weighted(build_, point_, up[0]) - dot(up[0], p)};
        }
        const auto p = polynomials(build_, s, piece.curve);
        const auto to_side = polynomials(build_, s, side), upwards = polynomials(build_, s, up);
        const std::array<Expression, 3> way{point_[0] - p[0], point_[1] - p[1], point_[2] - p[2]};
        return {product(way, to_side), product(way, upwards)};
    }

    /// The scalar product without the terms that are 0.
    Expression product(const std::array<Expression, 3>& a, const std::array<Expression, 3>& b) {
        std::optional<Expression> sum;
        for (std::size_t i = 0; i < 3; ++i) {
            if (build_.graph.constant_value(b[i].id()) == 0.0) continue;
            const Expression term = a[i] * b[i];
            sum = sum ? *sum + term : term;
        }
        return sum ? *sum : build_.constant(0.0);
    }

    Build& build_;
    Array x_;
    Expression f_;
    const Path& path_;
    std::array<Expression, 3> point_;
};

std::optional<Vec3> numbers(Build& build, Array items) {
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = known(build, items[i]);
        if (!number || !(math::abs(*number) < far_away)) return std::nullopt;
        out[i] = *number;
    }
    return Vec3{out[0], out[1], out[2]};
}

template <class MakePath>
Expression sweep(Build& build, Array x, Expression f, Array points, Array side, MakePath make_path) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const auto place = numbers(build, points.subspan(i, 3));
        if (!place) return build.error("points must be numbers that do not depend on the point");
        places.push_back(*place);
    }
    const auto first_side = numbers(build, side);
    if (!first_side) return build.error("side must be numbers that do not depend on the point");
    const Path path = make_path(places, *first_side);
    if (!path.problem.empty()) return build.error(path.problem);
    const auto value = ContourSweep(build, x, f, path).value();
    return value ? *value : build.constant(error_value);
}

}  // namespace

Expression sweep_contour_polygon(Build& build, Array x, Expression f, Array points, Array side) {
    if (x.size() != 3 || side.size() != 3) return build.error("x and side must have 3 items each");
    if (points.size() < 6 || points.size() % 3 != 0)
        return build.error("points must have three items for each of two or more points");
    return sweep(build, x, f, points, side, polygon_path);
}

Expression sweep_contour_bezier(Build& build, Array x, Expression f, Array points, Array side) {
    if (x.size() != 3 || side.size() != 3) return build.error("x and side must have 3 items each");
    if (points.size() < 12 || points.size() % 9 != 3)
        return build.error("points must have three items for each of 4, 7, 10, ... points");
    return sweep(build, x, f, points, side, bezier_path);
}

}  // namespace frep::shapes
