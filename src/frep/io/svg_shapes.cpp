// Shapes of SVG elements. See svg_shapes.h.
#include "frep/io/svg_shapes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frep/io/read_formats.h"
#include "frep/io/svg_data.h"

namespace frep::reading {

namespace {

using Problem = std::optional<ElementError>;

/// A length attribute; `whole` and `missing` as in read_length().
struct LengthRow {
    const char* name;
    double whole;
    double& out;
    double missing = 0;
};
Problem read_lengths(pugi::xml_node node, std::initializer_list<LengthRow> rows) {
    for (const LengthRow& row : rows)
        if (auto problem = read_length(node.attribute(row.name), row.whole, row.out, row.missing))
            return problem;
    return std::nullopt;
}

Problem draw_path_data(pugi::xml_node node, CurveWriter& out) {
    const pugi::xml_attribute d = node.attribute("d");
    if (auto error = draw_path(d.value(), out))
        return ElementError{d, error->offset, std::move(error->message)};
    return std::nullopt;
}

Problem draw_points(pugi::xml_node node, bool closed, CurveWriter& out) {
    const pugi::xml_attribute points = node.attribute("points");
    std::vector<double> v;
    if (auto error = parse_numbers(points.value(), v))
        return ElementError{points, error->offset, std::move(error->message)};
    if (v.size() % 2 != 0) return ElementError{points, 0, "points are pairs of numbers"};
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) i ? out.line({v[i], v[i + 1]}) : out.move({v[0], v[1]});
    if (closed && v.size() > 2) out.close();
    return std::nullopt;
}

Problem draw_line(pugi::xml_node node, Vec2 view, CurveWriter& out) {
    Vec2 a, b;
    if (auto problem = read_lengths(
            node, {{"x1", view.x, a.x}, {"y1", view.y, a.y}, {"x2", view.x, b.x}, {"y2", view.y, b.y}}))
        return problem;
    out.move(a);
    out.line(b);
    return std::nullopt;
}

Problem draw_rectangle(pugi::xml_node node, Vec2 view, CurveWriter& out) {
    double x = 0, y = 0, w = 0, h = 0, rx = 0, ry = 0;
    if (auto problem = read_lengths(node, {{"x", view.x, x},
                                           {"y", view.y, y},
                                           {"width", view.x, w},
                                           {"height", view.y, h},
                                           {"rx", view.x, rx, -1},
                                           {"ry", view.y, ry, -1}}))
        return problem;
    if (w < 0 || h < 0) return ElementError{{}, 0, "a width or height below 0"};
    if (w == 0 || h == 0) return std::nullopt;
    const double wide = rx < 0 ? ry : rx, high = ry < 0 ? rx : ry;
    rx = std::clamp(wide, 0.0, 0.5 * w);
    ry = std::clamp(high, 0.0, 0.5 * h);
    const ArcShape round{rx, ry, 0, false, true};
    out.move({x + rx, y});
    out.line({x + w - rx, y});
    out.arc(round, {x + w, y + ry});
    out.line({x + w, y + h - ry});
    out.arc(round, {x + w - rx, y + h});
    out.line({x + rx, y + h});
    out.arc(round, {x, y + h - ry});
    out.line({x, y + ry});
    out.arc(round, {x + rx, y});
    out.close();
    return std::nullopt;
}

Problem draw_ellipse(pugi::xml_node node, bool circle, Vec2 view, CurveWriter& out) {
    double cx = 0, cy = 0, rx = 0, ry = 0;
    const double missing = circle ? 0 : -1;
    if (auto problem =
            read_lengths(node, {{"cx", view.x, cx},
                                {"cy", view.y, cy},
                                {circle ? "r" : "rx", circle ? diagonal_unit(view) : view.x, rx, missing},
                                {circle ? "r" : "ry", circle ? diagonal_unit(view) : view.y, ry, missing}}))
        return problem;
    const double a = rx < 0 ? ry : rx, b = ry < 0 ? rx : ry;
    if (a > 0 && b > 0) out.ellipse({cx, cy}, a, b);
    return std::nullopt;
}

}  // namespace

std::optional<std::string> parse_svg_length(std::string_view text, double whole, double& out) {
    const auto read = parse_length(text);
    const auto unit = read ? millimetres(read->unit) : std::nullopt;
    if (read && read->unit.empty())
        out = read->number;
    else if (read && read->unit == "%")
        out = read->number / 100 * whole;
    else if (unit)
        out = read->number * *unit / *millimetres("px");
    else
        return fmt::format("expected a length, found {}", quoted(text));
    return std::nullopt;
}

std::optional<ElementError> read_length(pugi::xml_attribute attribute, double whole, double& out,
                                        double missing) {
    out = missing;
    const std::string_view text = attribute.value();
    if (text.empty() || text == "auto") return std::nullopt;
    if (auto error = parse_svg_length(text, whole, out)) return ElementError{attribute, 0, std::move(*error)};
    return std::nullopt;
}

double diagonal_unit(Vec2 view) { return std::sqrt(0.5 * (view.x * view.x + view.y * view.y)); }

bool is_shape(std::string_view name) {
    constexpr std::string_view names[] = {"path", "rect", "circle", "ellipse", "line", "polygon", "polyline"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::optional<ElementError> draw_shape(pugi::xml_node node, std::string_view name, Vec2 view,
                                       CurveWriter& out) {
    if (name == "path") return draw_path_data(node, out);
    if (name == "rect") return draw_rectangle(node, view, out);
    if (name == "line") return draw_line(node, view, out);
    if (name == "circle" || name == "ellipse") return draw_ellipse(node, name == "circle", view, out);
    return draw_points(node, name == "polygon", out);
}

}  // namespace frep::reading
