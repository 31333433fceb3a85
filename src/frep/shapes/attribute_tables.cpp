// Attribute functions that look up rows of tables, and their rows in the library. See attributes.h.
#include <string>

#include "frep/shapes/attributes.h"
#include "frep/shapes/binding.h"
#include "frep/shapes/noise.h"

namespace frep::shapes {

namespace {

constexpr double two_pi = 6.28318530717958647692;
constexpr const char* needs_rows = "the table must have a row as long as o for every item of map";

bool is_table(ArrayInOut o, Array rows, Array map) {
    return !o.empty() && !map.empty() && rows.size() == o.size() * map.size();
}

/// Item `column` of the row at t, `outside` where t is in no interval of the map. The first interval that
/// holds t counts.
template <bool smooth>
Expression table_item(Expression t, Array rows, Array map, std::size_t columns, std::size_t column,
                      Expression outside) {
    Expression value = outside;
    for (std::size_t i = map.size() - 1; i-- > 0;) {
        Expression item = rows[i * columns + column];
        if (smooth) {
            const Expression f = (t - map[i]) / (map[i + 1] - map[i]);
            item = (1.0 - f) * item + f * rows[(i + 1) * columns + column];
        }
        const Expression here = logical_and(less_equal(map[i], t), less(t, map[i + 1]));
        value = select(here, item, value);
    }
    return value;
}

/// Look-up for circles and crackles, in a copy of the table whose item number size(map)+1 may count as 1.1.
template <bool overwrite>
Expression ring_look_up(Build& build, Expression t, ArrayInOut o, Array rows, Array map) {
    if (!is_table(o, rows, map)) return build.error(needs_rows);
    std::vector<Expression> table(rows.begin(), rows.end());
    if (overwrite && map.size() < table.size()) table[map.size()] = build.constant(1.1);
    for (std::size_t j = 0; j < o.size(); ++j) o[j] = table_item<false>(t, table, map, o.size(), j, o[j]);
    return build.constant(1.0);
}

}  // namespace

template <bool smooth, bool first_below>
Expression look_up(Build& build, Expression t, ArrayInOut o, Array rows, Array map) {
    if (!is_table(o, rows, map)) return build.error(needs_rows);
    const std::size_t last = (map.size() - 1) * o.size();
    for (std::size_t j = 0; j < o.size(); ++j) {
        o[j] = table_item<smooth>(t, rows, map, o.size(), j, rows[last + j]);
        if (first_below) o[j] = select(less(t, map[0]), rows[j], o[j]);
    }
    return build.constant(1.0);
}

template <bool overwrite>
Expression circles(Build& build, Array x, ArrayInOut o, Array rows, Array map) {
    if (x.size() != 3) return build.error("x must have 3 items");
    const Expression distance = sqrt(norm2(vec3(x)));
    return ring_look_up<overwrite>(build, distance - floor(distance), o, rows, map);
}

template <bool overwrite>
Expression crackles(Build& build, Array x, ArrayInOut o, Expression freq, Array rows, Array map) {
    if (x.size() != 3) return build.error("x must have 3 items");
    const Expression one = build.constant(1.0);
    const Expression phase = (abs(x[0]) + abs(x[1]) + abs(x[2])) / 3.0;
    const auto part = [&](Expression a, Expression b) {
        return gardner_series(a, a, b, one, freq, phase) / gardner_bound;
    };
    const Expression v = part(x[0], x[2]) + part(x[1], x[0]) + part(x[2], x[1]);
    const Expression fraction = trunc((v - floor(v)) * 1000.0) / 1000.0;
    const Expression t = (1.0 + sin(two_pi * fraction)) / 2.0;
    return ring_look_up<overwrite>(build, t, o, rows, map);
}

Expression spline(Build& build, ArrayInOut o, Array list, Expression v, Expression vmin, Expression vmax) {
    const std::size_t columns = o.size();
    if (columns == 0 || list.size() % columns != 0 || list.size() < 4 * columns)
        return build.error("the list must have 4 or more rows as long as o");
    const std::size_t rows = list.size() / columns;
    const double spans = static_cast<double>(rows - 3);
    const Expression t = (v - vmin) / (vmax - vmin);
    const Expression along = t * spans;
    const Expression span = min(max(floor(along), 0.0), spans - 1.0);
    const Expression u = along - span;
    for (std::size_t j = 0; j < columns; ++j) {
        std::vector<Expression> column;
        for (std::size_t i = 0; i < rows; ++i) column.push_back(list[i * columns + j]);
        Expression p[4];
        for (int k = 0; k < 4; ++k) p[k] = block(build, Op::pick, {span + (k + 1.0)}, column);
        const Expression a = p[2] - p[0], b = 2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3],
                         c = 3.0 * (p[1] - p[2]) + p[3] - p[0];
        const Expression curve = p[1] + 0.5 * u * (a + u * (b + u * c));
        o[j] = select(less(t, 0.0), column.front(), select(less(1.0, t), column.back(), curve));
    }
    return build.constant(1.0);
}

Rows attribute_table_rows() {
    constexpr std::string_view from = "schmitt2001";
    constexpr std::string_view below = "Below the first number of the map the answer is the last row; ";
    static const std::string row_note = std::string(below) + "hfA_LookUp gives the first.";
    static const std::string smooth_note = std::string(below) + "hfA_SmoothLookUp gives the first.";
    constexpr std::string_view overwrite = "Item number size(map)+1 of the table counts as 1.1; ";
    static const std::string circle_note = std::string(overwrite) + "hfA_Rings takes the table as it is.";
    static const std::string crackle_note = std::string(overwrite) + "hfA_Cracks takes the table as it is.";
    constexpr std::string_view circle_doc = "Concentric rings about the origin, one set a unit.";
    constexpr std::string_view crackle_doc = "Crackled glaze: a table seen through three noises.";
    constexpr std::string_view circle_formula =
        "o = row i of attrs where map_i <= t < map_(i+1), t = |x| - floor |x|; o stays elsewhere";
    constexpr std::string_view crackle_formula =
        "as hfA_Circles with t = (1 + sin(2 pi w))/2, w = fraction of the sum of three Gardner noises, in "
        "thousandths";
    return {
        row<&look_up<false, false>>(
            "hfA_LookUpTable", "t, o, attrs, map",
            {"Row of a table by increasing numbers.",
             "o = row i of attrs where map_i <= t < map_(i+1), else the last row", from, row_note}),
        row<&look_up<false, true>>(
            "hfA_LookUp", "t, o, attrs, map",
            {"Row of a table by increasing numbers.",
             "o = row i of attrs where map_i <= t < map_(i+1), the first row below, the last row above"},
            false),
        row<&look_up<true, false>>(
            "hfA_SmoothLookUpTable", "t, o, attrs, map",
            {"Mix of neighbouring rows of a table.",
             "o = mix of rows i, i+1 where map_i <= t < map_(i+1), else the last row", from, smooth_note}),
        row<&look_up<true, true>>(
            "hfA_SmoothLookUp", "t, o, attrs, map",
            {"Mix of neighbouring rows of a table.",
             "o = mix of rows i, i+1 where map_i <= t < map_(i+1), the first row below, the last row above"},
            false),
        row<&circles<true>>("hfA_Circles", "x, o, attrs, map",
                            {circle_doc, circle_formula, from, circle_note}),
        row<&circles<false>>("hfA_Rings", "x, o, attrs, map", {circle_doc, circle_formula}, false),
        row<&crackles<true>>("hfA_Crackles", "x, o, freq, attrs, map",
                             {crackle_doc, crackle_formula, from, crackle_note}),
        row<&crackles<false>>("hfA_Cracks", "x, o, freq, attrs, map", {crackle_doc, crackle_formula}, false),
        row<&spline>(
            "hfA_Spline", "o, list, x, xmin, xmax",
            {"Catmull-Rom curve through the rows of a list.",
             "o = curve at t = (x-xmin)/(xmax-xmin) from the second row to the last but one; the first "
             "row for t < 0, the last for t > 1",
             "catmull1974", "At t = 1 the old code read outside the list; here the curve ends there."}),
    };
}

}  // namespace frep::shapes
