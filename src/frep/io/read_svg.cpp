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

namespace frep {

namespace {

using namespace reading;
using pugi::xml_node;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t most_elements = 200'000;  ///< visited, elements shown by `use` counted each time
constexpr int most_depth = 100;

/// What elements inherit.
struct Style {
    bool filled = true, visible = true;
    FillRule rule = FillRule::nonzero;
};

class Drawing {
  public:
    explicit Drawing(std::string_view bytes) : bytes_(bytes), text_(bytes) {}

    Result<AreaFile> read() {
        const pugi::xml_parse_result parsed = document_.load_buffer_inplace(
            text_.data(), text_.size(), pugi::parse_default, pugi::encoding_auto);
        if (!parsed) return error_at(static_cast<std::size_t>(parsed.offset), parsed.description());
        const xml_node root = document_.document_element();
        if (local_name(root) != "svg") return error_at(offset_of(root), "the root element is no `svg`");
        Affine map;
        if (const Status status = root_map(root, map); !status) return status.error();
        if (const Status status = visit(root, map, {}, 0); !status) return status.error();
        return finish(root);
    }

  private:
    /// The element's name without a prefix: Inkscape's svg:path is a path.
    static std::string_view local_name(xml_node node) {
        const std::string_view name = node.name();
        const std::size_t colon = name.find(':');
        return colon == std::string_view::npos ? name : name.substr(colon + 1);
    }

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

    /// The value of a property: `style` before the attribute; empty when neither says it.
    static std::string_view property(xml_node node, std::string_view name) {
        std::string_view style = node.attribute("style").value();
        const auto trimmed = [](std::string_view s) {
            while (!s.empty() && (s.front() == ' ' || s.front() == '\n' || s.front() == '\t'))
                s.remove_prefix(1);
            while (!s.empty() && (s.back() == ' ' || s.back() == '\n' || s.back() == '\t'))
                s.remove_suffix(1);
            return s;
        };
        while (!style.empty()) {
            const std::size_t end = std::min(style.find(';'), style.size());
            const std::string_view declaration = style.substr(0, end);
            style.remove_prefix(std::min(end + 1, style.size()));
            const std::size_t colon = declaration.find(':');
            if (colon != std::string_view::npos && trimmed(declaration.substr(0, colon)) == name)
                return trimmed(declaration.substr(colon + 1));
        }
        return trimmed(node.attribute(std::string(name).c_str()).value());
    }

    static Style inherited(xml_node node, Style style) {
        const std::string_view fill = property(node, "fill"), rule = property(node, "fill-rule"),
                               visibility = property(node, "visibility");
        if (!fill.empty() && fill != "inherit") style.filled = fill != "none" && fill != "transparent";
        if (rule == "evenodd") style.rule = FillRule::even_odd;
        if (rule == "nonzero") style.rule = FillRule::nonzero;
        if (visibility == "visible") style.visible = true;
        if (visibility == "hidden" || visibility == "collapse") style.visible = false;
        return style;
    }

    /// A length in user units; `whole` is what 100% is.
    Result<double> length(xml_node node, const char* name, double whole, double missing = 0) const {
        const pugi::xml_attribute attribute = node.attribute(name);
        const std::string_view text = attribute.value();
        if (text.empty() || text == "auto") return missing;
        const auto read = parse_length(text);
        if (read && read->unit.empty()) return read->number;
        if (read && read->unit == "%") return read->number / 100 * whole;
        const auto unit = read ? millimetres(read->unit) : std::nullopt;
        if (!unit)
            return error_in(node, attribute, 0, fmt::format("expected a length, found {}", quoted(text)));
        return read->number * *unit / *millimetres("px");
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
        if (property(node, "display") == "none") return {};
        const Style style = inherited(node, outer_style);
        Affine map;
        const pugi::xml_attribute transform = node.attribute("transform");
        if (const auto error = parse_transform(transform.value(), map))
            return error_in(node, transform, error->offset, error->message);
        map = outer * map;
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
        return draw(node, name, map, style);
    }

    /// An inner svg or symbol has a place and a view of its own.
    Status nested_map(xml_node node, Affine& map) {
        auto box = view_box(node);
        if (!box) return box.error();
        double v[4] = {0, 0, 0, 0};
        const char* names[4] = {"x", "y", "width", "height"};
        for (int i = 0; i < 4; ++i) {
            const auto value = length(node, names[i], i % 2 ? view_.y : view_.x);
            if (!value) return value.error();
            v[i] = *value;
        }
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
        if (ids_.empty()) collect_ids();
        const auto found = ids_.find(std::string(name.substr(1)));
        if (found == ids_.end())
            return error_in(node, href, 0, fmt::format("there is no element {}", quoted(name)));
        const auto x = length(node, "x", view_.x), y = length(node, "y", view_.y);
        if (!x) return x.error();
        if (!y) return y.error();
        return visit(found->second, map * Affine{1, 0, 0, 1, *x, *y}, style, depth + 1);
    }

    /// A walk without recursion: files may nest as deep as they like in parts that are not shown.
    void collect_ids() {
        xml_node node = document_.document_element();
        while (node) {
            if (const pugi::xml_attribute id = node.attribute("id")) ids_.emplace(id.value(), node);
            xml_node next = node.first_child();
            while (!next && node) {
                next = node.next_sibling();
                if (!next) node = node.parent();
            }
            node = next;
        }
        ids_.emplace("", xml_node());  // not empty, even without names
    }

    void note(std::string_view what) { ++left_out_[std::string(what)]; }

    Status draw(xml_node node, std::string_view name, const Affine& map, const Style& style) {
        CurveWriter out(map);
        if (name == "path") {
            const pugi::xml_attribute d = node.attribute("d");
            if (const auto error = draw_path(d.value(), out))
                return error_in(node, d, error->offset, error->message);
        } else if (name == "polygon" || name == "polyline") {
            if (const Status status = draw_points(node, out); !status) return status;
        } else if (name == "rect") {
            if (const Status status = draw_rectangle(node, out); !status) return status;
        } else if (name == "circle" || name == "ellipse") {
            if (const Status status = draw_ellipse(node, name == "circle", out); !status) return status;
        } else {
            if (name == "text" || name == "image" || name == "style" || name == "foreignObject")
                note(fmt::format("`{}`", name));
            return {};
        }
        std::vector<CurveContour> contours = out.take();
        for (const CurveContour& contour : contours) segments_ += contour.segments.size() + 1;
        if (segments_ > most_area_edges)
            return Error{ErrorKind::over_limit, fmt::format("more than {} edges", most_area_edges)};
        if (!style.visible) return {};
        if (!style.filled) {
            ++unfilled_;
            return {};
        }
        if (!contours.empty()) parts_.push_back({std::move(contours), style.rule});
        return {};
    }

    Status draw_points(xml_node node, CurveWriter& out) {
        const pugi::xml_attribute points = node.attribute("points");
        std::vector<double> v;
        if (const auto error = parse_numbers(points.value(), v))
            return error_in(node, points, error->offset, error->message);
        if (v.size() % 2 != 0) return error_in(node, points, 0, "points are pairs of numbers");
        for (std::size_t i = 0; i + 1 < v.size(); i += 2)
            i ? out.line({v[i], v[i + 1]}) : out.move({v[0], v[1]});
        return {};
    }

    Status draw_rectangle(xml_node node, CurveWriter& out) {
        double v[6];
        const char* names[6] = {"x", "y", "width", "height", "rx", "ry"};
        for (int i = 0; i < 6; ++i) {
            const auto value = length(node, names[i], i % 2 ? view_.y : view_.x, i < 4 ? 0 : -1);
            if (!value) return value.error();
            v[i] = *value;
        }
        const double x = v[0], y = v[1], w = v[2], h = v[3];
        if (w < 0 || h < 0) return error_at(offset_of(node), "a width or height below 0");
        if (w == 0 || h == 0) return {};
        double rx = v[4] < 0 ? v[5] : v[4], ry = v[5] < 0 ? v[4] : v[5];
        rx = std::clamp(rx, 0.0, 0.5 * w);
        ry = std::clamp(ry, 0.0, 0.5 * h);
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
        return {};
    }

    Status draw_ellipse(xml_node node, bool circle, CurveWriter& out) {
        const double whole = std::sqrt(0.5 * (view_.x * view_.x + view_.y * view_.y));
        const auto cx = length(node, "cx", view_.x), cy = length(node, "cy", view_.y);
        const auto rx = length(node, circle ? "r" : "rx", circle ? whole : view_.x, circle ? 0 : -1);
        const auto ry = length(node, circle ? "r" : "ry", circle ? whole : view_.y, circle ? 0 : -1);
        for (const auto* value : {&cx, &cy, &rx, &ry})
            if (!*value) return value->error();
        const double a = *rx < 0 ? *ry : *rx, b = *ry < 0 ? *rx : *ry;
        if (a > 0 && b > 0) out.ellipse({*cx, *cy}, a, b);
        return {};
    }

    Result<AreaFile> finish(xml_node root) {
        if (parts_.empty())
            return error_at(offset_of(root),
                            unfilled_ > 0 ? "nothing is filled: all shapes have `fill` none, and strokes "
                                            "are not read"
                                          : "there is no path or shape");
        Box2 box;
        for (const Curves& part : parts_) {
            const Box2 one = box_of(part.contours);
            if (one.is_empty()) continue;
            box.add(one.min);
            box.add(one.max);
        }
        AreaFile out;
        std::size_t edges = 0;
        for (const Curves& part : parts_) {
            FilledPart filled{polygons_of(part.contours, curve_tolerance * box.larger_side()), part.rule};
            for (const auto& polygon : filled.contours) edges += polygon.size();
            if (edges > most_area_edges)
                return Error{ErrorKind::over_limit, fmt::format("more than {} edges", most_area_edges)};
            if (!filled.contours.empty()) out.area.parts.push_back(std::move(filled));
        }
        if (out.area.parts.empty()) return error_at(offset_of(root), "the filled shapes have no area");
        for (const auto& [what, count] : left_out_)
            out.notes.push_back(fmt::format("{} is not read ({} times)", what, count));
        if (unfilled_ > 0)
            out.notes.push_back(fmt::format("{} shapes are not filled and count for nothing", unfilled_));
        return out;
    }

    struct Curves {
        std::vector<CurveContour> contours;
        FillRule rule;
    };

    std::string_view bytes_;
    std::string text_;
    pugi::xml_document document_;
    Vec2 view_{100, 100};
    std::map<std::string, xml_node> ids_;
    std::map<std::string, std::size_t> left_out_;
    std::vector<Curves> parts_;
    std::size_t elements_ = 0, segments_ = 0, unfilled_ = 0, work_ = 0;
};

}  // namespace

Result<AreaFile> read_svg(std::string_view bytes) {
    if (bytes.size() > most_bytes)
        return Error{ErrorKind::over_limit, fmt::format("an SVG file of more than {} MiB", most_bytes >> 20)};
    return Drawing(bytes).read();
}

}  // namespace frep
