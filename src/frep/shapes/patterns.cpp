// Arrays of copies and their rows. See patterns.h.
#include "frep/shapes/patterns.h"

#include <fmt/format.h>

#include "frep/math/number.h"
#include "frep/shapes/at_point.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/set_operations.h"

namespace frep::shapes {

namespace {

constexpr int most_copies = 1000;

/// Cosine and sine of k/n of a turn; exact for quarters.
struct Direction {
    double cosine, sine;
};
Direction direction(int k, int n) {
    constexpr Direction quarters[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    if (4 * k % n == 0) return quarters[4 * k / n % 4];
    const double angle = 2 * math::pi * k / n;
    return {math::cos(angle), math::sin(angle)};
}

/// The union of f at place(0), place(1), ...: arrays like x.
template <class Place>
Expression copies(Build& build, Array x, Expression f, Expression count, Place place) {
    const auto number = known(build, count);
    if (!number || !(*number >= 0.5) || !(*number < most_copies + 0.5))
        return build.error(
            fmt::format("the number of copies must be a known whole number of 1..{}", most_copies));
    const int n = static_cast<int>(*number + 0.5);
    std::vector<Expression> all;
    for (int k = 0; k < n; ++k) {
        const auto copy = at_point(build, f, x, place(k, n));
        if (!copy) return build.error("f depends on the point in another way than by the items of x");
        all.push_back(*copy);
    }
    return disjunction(build.set_system, all);
}

}  // namespace

template <int axis>
Expression polar_array(Build& build, Array x, Expression f, Expression count) {
    constexpr std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (x.size() <= u || x.size() <= v) return build.error("x must have the two coordinates across the axis");
    return copies(build, x, f, count, [&](int k, int n) {
        const Direction d = direction(k, n);
        std::vector<Expression> place(x.begin(), x.end());
        place[u] = x[u] * d.cosine + x[v] * d.sine;
        place[v] = x[v] * d.cosine - x[u] * d.sine;
        return place;
    });
}

Expression linear_array(Build& build, Array x, Expression f, Array offset, Expression count) {
    if (offset.empty() || offset.size() > x.size())
        return build.error("d must have one item or more, and not more than x");
    return copies(build, x, f, count, [&](int k, int) {
        std::vector<Expression> place(x.begin(), x.end());
        for (std::size_t i = 0; i < offset.size(); ++i) place[i] = x[i] - offset[i] * static_cast<double>(k);
        return place;
    });
}

Rows pattern_rows() {
    constexpr std::string_view note =
        "Every copy is in the model in full, up to 1000; where a copy does not matter it costs nothing. f "
        "must "
        "depend on the point by the items of x only.";
    constexpr std::string_view formula =
        "f at x turned back by 0, 1/n, 2/n ... of a turn, united by the file's system of operations";
    return {
        row<&polar_array<0>>("hfPolarArrayX", "x, f, n",
                             {"n copies of f about the x axis, equally spaced.", formula, {}, note}, false),
        row<&polar_array<1>>("hfPolarArrayY", "x, f, n",
                             {"n copies of f about the y axis, equally spaced.", formula, {}, note}, false),
        row<&polar_array<2>>(
            "hfPolarArrayZ", "x, f, n",
            {"n copies of f about the z axis, equally spaced; also in the plane.", formula, {}, note}, false),
        row<&linear_array>("hfLinearArray", "x, f, d, n",
                           {"n copies of f at 0, d, 2 d and so on; of rows again: a grid.",
                            "f(x) | f(x - d) | f(x - 2 d) ..., by the file's system of operations",
                            {},
                            note},
                           false),
    };
}

}  // namespace frep::shapes
