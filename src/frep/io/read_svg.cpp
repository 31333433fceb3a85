// Drawings as areas. See read_svg.h.
#include "frep/io/read_svg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "frep/io/read_formats.h"
#include "frep/io/svg_data.h"
#include "frep/io/svg_shapes.h"
#include "frep/io/svg_style.h"

namespace frep {

namespace {

using namespace reading;
using pugi::xml_node;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t most_marks = 4'000'000;  ///< tags and attributes of the text: each takes up to 64 bytes
constexpr double most_coordinate = 1e12;       ///< after all transforms
constexpr double most_scale = 1e100;           ///< of all transforms together
constexpr std::size_t most_elements = 200'000;  ///< visited, elements shown by `use` counted each time
constexpr int most_depth = 100;

/// A painted element: contours in its own coordinates, and their way to the model's.
struct Shape {
    std::vector<CurveContour> contours;
    Affine map;
    bool is_filled, is_stroked;
    Style style;
};

class Drawing {
  public:
    explicit Drawing(std::string_view bytes) : bytes_(bytes), text_(bytes) {}

    Result<AreaFile> read() {
        const auto marks =
            std::count_if(text_.begin(), text_.end(), [](char c) { return c == '<' || c == '='; });
        if (static_cast<std::size_t>(marks) > most_marks)
            return Error{ErrorKind::over_limit, fmt::format("more than {} tags and attributes", most_marks)};
        const pugi::xml_parse_result parsed = document_.load_buffer_inplace(
            text_.data(), text_.size(), pugi::parse_default, pugi::encoding_auto);
        if (!parsed) return error_at(static_cast<std::size_t>(parsed.offset), parsed.description());
        const xml_node root = document_.document_element();
        if (local_name(root) != "svg") return error_at(offset_of(root), "the root element is no `svg`");
        if (const Status status = collect(); !status) return status.error();
        Affine map;
        if (const Status status = root_map(root, map); !status) return status.error();
        if (const Status status = visit(root, map, {}, 0); !status) return status.error();
        return finish(root);
    }

  private:
    Error error_at(std::size_t offset, std::string_view message) const {
        const std::string_view before = bytes_.substr(0, std::min(offset, bytes_.size()));
        const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
        return {ErrorKind::io, fmt::format("{}:{}: {}", 1 + std::count(before.begin(), before.end(), '\n'),
                                           1 + before.size() - line_start, message)};
    }
    std::size_t offset_of(xml_node node) const {
        const std::ptrdiff_t offset = node.offset_debug();
        return offset > 0 ? static_cast<std::size_t>(offset) : 0;
    }
    /// The parser works inside `text_`, where values lie at their places (unless they hold entities).
    Error error_in(xml_node node, pugi::xml_attribute attribute, std::size_t at,
                   std::string_view message) const {
        const char* value = attribute.value();
        const bool inside = value >= text_.data() && value < text_.data() + text_.size();
        return error_at(inside ? static_cast<std::size_t>(value - text_.data()) + at : offset_of(node),
                        message);
    }

    Error error_in(xml_node node, const ElementError& error) const {
        return error.attribute ? error_in(node, error.attribute, error.offset, error.message)
                               : error_at(offset_of(node), error.message);
    }

    /// The numbers of a viewBox; empty when there is none.
    Result<std::vector<double>> view_box(xml_node node) const {
        const pugi::xml_attribute attribute = node.attribute("viewBox");
        std::vector<double> box;
        if (const auto error = parse_numbers(attribute.value(), box))
            return error_in(node, attribute, error->offset, error->message);
        if (!box.empty() && (box.size() != 4 || !(box[2] > 0) || !(box[3] > 0)))
            return error_in(node, attribute, 0, "a viewBox has four numbers, its width and height above 0");
        return box;
    }

    /// Model units per user unit, y turned up.
    Status root_map(xml_node root, Affine& map) {
        auto box = view_box(root);
        if (!box) return box.error();
        if (!box->empty()) view_ = {(*box)[2], (*box)[3]};
        double scale = 0;
        const double sides[2] = {view_.x, view_.y};
        const char* names[2] = {"width", "height"};
        for (int i = 0; i < 2; ++i) {
            const auto size = parse_length(root.attribute(names[i]).value());
            if (!size || size->unit.empty() || size->unit == "px" || !(size->number > 0)) continue;
            const auto unit = millimetres(size->unit);
            if (!unit) continue;
            const double here = box->empty() ? *millimetres("px") : size->number * *unit / sides[i];
            scale = scale > 0 ? std::min(scale, here) : here;
        }
        if (!(scale > 0)) scale = 1;
        map = {scale, 0, 0, -scale, 0, 0};
        return {};
    }

    Status visit(xml_node node, const Affine& outer, const Style& outer_style, int depth) {
        if (++elements_ > most_elements)
            return Error{ErrorKind::over_limit, fmt::format("more than {} elements", most_elements)};
        for (const pugi::xml_attribute attribute : node.attributes())
            work_ += std::string_view(attribute.value()).size();
        if (work_ > 4 * most_bytes)
            return Error{ErrorKind::over_limit, "elements are shown too often by `use`"};
        if (depth > most_depth)
            return Error{
                ErrorKind::over_limit,
                error_at(offset_of(node), fmt::format("elements nest deeper than {}", most_depth)).message};
        const std::string_view name = local_name(node);
        const Declarations declarations = sheets_.of(node);
        if (declarations[Property::display] == "none") return {};
        Style style = inherited(declarations, outer_style);
        if (const std::string_view width = declarations[Property::stroke_width]; !width.empty())
            if (const auto error = parse_svg_length(width, diagonal_unit(view_), style.pen.width))
                return error_at(offset_of(node), "stroke-width: " + *error);
        Affine map;
        const pugi::xml_attribute transform = node.attribute("transform");
        if (const auto error = parse_transform(transform.value(), map))
            return error_in(node, transform, error->offset, error->message);
        map = outer * map;
        if (!(map.norm() + std::fabs(map.e) + std::fabs(map.f) <= most_scale))
            return error_at(offset_of(node), "the transforms lead beyond all bounds");
        if (name == "svg" || name == "g" || name == "a" || name == "symbol" || name == "switch") {
            if (name != "g" && name != "a" && depth > 0)
                if (const Status status = nested_map(node, map); !status) return status;
            for (const xml_node child : node.children()) {
                if (child.type() != pugi::node_element || local_name(child) == "symbol") continue;
                if (const Status status = visit(child, map, style, depth + 1); !status) return status;
            }
            return {};
        }
        if (name == "use") return visit_used(node, map, style, depth);
        if (is_shape(name)) return draw(node, name, map, style, declarations);
        if (name == "text" || name == "image" || name == "foreignObject") note(fmt::format("`{}`", name));
        return {};
    }

    /// An inner svg or symbol has a place and a view of its own.
    Status nested_map(xml_node node, Affine& map) {
        auto box = view_box(node);
        if (!box) return box.error();
        double v[4] = {0, 0, 0, 0};
        const char* names[4] = {"x", "y", "width", "height"};
        for (int i = 0; i < 4; ++i)
            if (const auto error = read_length(node.attribute(names[i]), i % 2 ? view_.y : view_.x, v[i]))
                return error_in(node, *error);
        map = map * Affine{1, 0, 0, 1, v[0], v[1]};
        if (box->empty()) return {};
        const std::vector<double>& b = *box;
        if (v[2] > 0 && v[3] > 0) {
            const double scale = std::min(v[2] / b[2], v[3] / b[3]);
            map = map * Affine{scale, 0, 0, scale, 0.5 * (v[2] - scale * b[2]), 0.5 * (v[3] - scale * b[3])};
        }
        map = map * Affine{1, 0, 0, 1, -b[0], -b[1]};
        return {};
    }

    Status visit_used(xml_node node, const Affine& map, const Style& style, int depth) {
        pugi::xml_attribute href = node.attribute("href");
        if (!href) href = node.attribute("xlink:href");
        const std::string_view name = href.value();
        if (name.size() < 2 || name[0] != '#') {
            note("`use` of something outside the file");
            return {};
        }
        const auto found = ids_.find(std::string(name.substr(1)));
        if (found == ids_.end())
            return error_in(node, href, 0, fmt::format("there is no element {}", quoted(name)));
        double x = 0, y = 0;
        if (const auto error = read_length(node.attribute("x"), view_.x, x)) return error_in(node, *error);
        if (const auto error = read_length(node.attribute("y"), view_.y, y)) return error_in(node, *error);
        return visit(found->second, map * Affine{1, 0, 0, 1, x, y}, style, depth + 1);
    }

    /// Names and style sheets, by a walk without recursion: files may nest as deep as they like in parts that
    /// are not shown.
    Status collect() {
        xml_node node = document_.document_element();
        while (node) {
            if (const pugi::xml_attribute id = node.attribute("id")) ids_.emplace(id.value(), node);
            if (local_name(node) == "style")
                for (const xml_node child : node.children())
                    if (const Status status = sheets_.add(child.value()); !status) return status;
            xml_node next = node.first_child();
            while (!next && node) {
                next = node.next_sibling();
                if (!next) node = node.parent();
            }
            node = next;
        }
        return {};
    }

    void note(std::string_view what) { ++left_out_[std::string(what)]; }

    Status draw(xml_node node, std::string_view name, const Affine& map, const Style& style,
                const Declarations& declarations) {
        CurveWriter out;
        if (const auto error = draw_shape(node, name, view_, out)) return error_in(node, *error);
        std::vector<CurveContour> contours = out.take();
        for (const CurveContour& contour : contours) segments_ += contour.segments.size() + 1;
        if (segments_ > most_area_edges)
            return Error{ErrorKind::over_limit, fmt::format("more than {} edges", most_area_edges)};
        if (!style.is_visible || contours.empty()) return {};
        for (const Property property : {Property::clip_path, Property::mask, Property::marker,
                                        Property::marker_start, Property::marker_mid, Property::marker_end})
            if (const std::string_view value = declarations[property]; !value.empty() && value != "none")
                note(fmt::format("`{}`", name_of(property)));
        const bool is_stroked = style.is_stroked && style.pen.width > 0;
        if (is_stroked && style.is_dashed) note("`stroke-dasharray`");
        if (is_stroked && declarations[Property::vector_effect] == "non-scaling-stroke")
            note("`non-scaling-stroke`");
        if (style.is_filled || is_stroked)
            shapes_.push_back({std::move(contours), map, style.is_filled, is_stroked, style});
        else
            ++unpainted_;
        return {};
    }

    /// The box of all that is painted.
    Box2 box_of_all() const {
        Box2 box;
        for (const Shape& shape : shapes_) {
            const double reach = shape.is_stroked ? 0.5 * shape.style.pen.width * shape.map.norm() : 0;
            for (const CurveContour& contour : shape.contours) {
                const Box2 one = box_of({mapped(contour, shape.map)});
                if (one.is_empty()) continue;
                box.add(one.min - Vec2{reach, reach});
                box.add(one.max + Vec2{reach, reach});
            }
        }
        return box;
    }

    std::vector<std::vector<Vec2>> filled(const Shape& shape, double tolerance, std::size_t most) const {
        std::vector<CurveContour> contours;
        for (const CurveContour& contour : shape.contours) contours.push_back(mapped(contour, shape.map));
        return polygons_of(contours, tolerance, most);
    }

    /// The pen keeps its shape in the element's own coordinates, where the lines are found.
    std::vector<std::vector<Vec2>> stroked(const Shape& shape, double tolerance, std::size_t most) const {
        std::vector<std::vector<Vec2>> out;
        const double inner = tolerance / shape.map.norm();
        std::size_t count = 0;
        for (const CurveContour& contour : shape.contours)
            append_stroke(points_of(contour, inner, most), contour.closed, shape.style.pen, inner, most,
                          count, out);
        for (auto& polygon : out)
            for (Vec2& p : polygon) p = shape.map(p);
        return out;
    }

    Result<AreaFile> finish(xml_node root) {
        if (shapes_.empty())
            return error_at(offset_of(root),
                            unpainted_ > 0 ? "nothing is painted: all shapes have neither fill nor stroke"
                                           : "there is no path or shape");
        const Box2 box = box_of_all();
        if (!(std::max({-box.min.x, -box.min.y, box.max.x, box.max.y}) <= most_coordinate))
            return error_at(offset_of(root),
                            "after all transforms coordinates are beyond 1e12, or not finite");
        const double tolerance = curve_tolerance * box.larger_side();
        AreaFile out;
        std::size_t edges = 0;
        const auto add = [&](FilledPart part) {
            for (const auto& polygon : part.contours) edges += polygon.size();
            if (!part.contours.empty()) out.area.parts.push_back(std::move(part));
        };
        for (const Shape& shape : shapes_) {
            if (shape.is_filled) add({filled(shape, tolerance, most_area_edges), shape.style.rule});
            if (shape.is_stroked && shape.map.norm() > 0)
                add({stroked(shape, tolerance, most_area_edges), FillRule::nonzero});
            if (edges > most_area_edges)
                return Error{ErrorKind::over_limit, fmt::format("more than {} edges", most_area_edges)};
        }
        if (out.area.parts.empty()) return error_at(offset_of(root), "the painted shapes have no area");
        std::map<std::string, std::size_t> left_out = left_out_;
        left_out.insert(sheets_.left_out().begin(), sheets_.left_out().end());
        for (const auto& [what, count] : left_out)
            out.notes.push_back(fmt::format("not read: {} ({} times)", what, count));
        if (unpainted_ > 0)
            out.notes.push_back(
                fmt::format("{} shapes have neither fill nor stroke and count for nothing", unpainted_));
        return out;
    }

    std::string_view bytes_;
    std::string text_;
    pugi::xml_document document_;
    Vec2 view_{100, 100};
    std::map<std::string, xml_node> ids_;
    std::map<std::string, std::size_t> left_out_;
    StyleSheets sheets_;
    std::vector<Shape> shapes_;
    std::size_t elements_ = 0, segments_ = 0, unpainted_ = 0, work_ = 0;
};

}  // namespace

Result<AreaFile> read_svg(std::string_view bytes) {
    if (bytes.size() > most_bytes)
        return Error{ErrorKind::over_limit, fmt::format("an SVG file of more than {} MiB", most_bytes >> 20)};
    return Drawing(bytes).read();
}

}  // namespace frep
