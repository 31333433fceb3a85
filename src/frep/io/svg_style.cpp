// Styles of SVG elements. See svg_style.h.
#include "frep/io/svg_style.h"

#include <algorithm>

#include <fmt/format.h>

#include "frep/io/read_formats.h"

namespace frep::reading {

namespace {

constexpr std::size_t most_selectors = 10'000;

constexpr std::array<std::string_view, property_count> names{"display",
                                                             "visibility",
                                                             "fill",
                                                             "fill-rule",
                                                             "stroke",
                                                             "stroke-width",
                                                             "stroke-linejoin",
                                                             "stroke-linecap",
                                                             "stroke-miterlimit",
                                                             "stroke-dasharray",
                                                             "vector-effect",
                                                             "clip-path",
                                                             "mask",
                                                             "marker",
                                                             "marker-start",
                                                             "marker-mid",
                                                             "marker-end"};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

/// The part before `end`; it and the mark are taken off.
std::string_view take_until(std::string_view& text, char end) {
    const std::size_t at = std::min(text.find(end), text.size());
    const std::string_view part = text.substr(0, at);
    text.remove_prefix(std::min(at + 1, text.size()));
    return part;
}

std::string without_comments(std::string_view css) {
    std::string out;
    while (true) {
        const std::size_t begin = css.find("/*");
        out += css.substr(0, begin);
        if (begin == std::string_view::npos) return out;
        const std::size_t end = css.find("*/", begin + 2);
        if (end == std::string_view::npos) return out;
        out += ' ';
        css.remove_prefix(end + 2);
    }
}

/// Goes past an @rule: to its semicolon, or to the end of its block.
void skip_at_rule(std::string_view& css) {
    int depth = 0;
    while (!css.empty()) {
        const char c = css.front();
        css.remove_prefix(1);
        if (c == '{') ++depth;
        if (c == '}') --depth;
        if (depth <= 0 && (c == ';' || c == '}')) return;
    }
}

bool is_word(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || static_cast<unsigned char>(c) >= 0x80;
    });
}

/// `path`, `*`, `.class`, `#id`, `path.class`, `path#id`.
bool is_simple(std::string_view selector) {
    if (selector.starts_with('*') && selector.size() > 1) return false;
    if (selector == "*") return true;
    const std::size_t mark = std::min(selector.find_first_of(".#"), selector.size());
    const std::string_view rest = selector.substr(std::min(mark + 1, selector.size()));
    return !selector.empty() && is_word(selector.substr(0, mark)) && is_word(rest) &&
           (mark == selector.size() || !rest.empty());
}

}  // namespace

std::string_view name_of(Property property) { return names[static_cast<std::size_t>(property)]; }

void Declarations::add(std::string_view text) {
    while (!text.empty()) {
        std::string_view value = take_until(text, ';');
        const std::string_view name = trimmed(take_until(value, ':'));
        value = trimmed(value);
        if (value.ends_with("!important")) value = trimmed(value.substr(0, value.size() - 10));
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end() && !value.empty())
            values_[static_cast<std::size_t>(found - names.begin())] = value;
    }
}

void Declarations::add(const Declarations& other) {
    for (std::size_t i = 0; i < property_count; ++i)
        if (!other.values_[i].empty()) values_[i] = other.values_[i];
}

std::string_view local_name(pugi::xml_node node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Status StyleSheets::add(std::string_view css) {
    std::string_view rest = texts_.emplace_back(without_comments(css));
    while (!(rest = trimmed(rest)).empty()) {
        if (rest.front() == '@') {
            ++left_out_["@-rules of style sheets"];
            skip_at_rule(rest);
            continue;
        }
        const std::string_view selectors = take_until(rest, '{');
        Declarations declarations;
        declarations.add(take_until(rest, '}'));
        if (const Status status = add_rule(selectors, declarations); !status) return status;
    }
    return {};
}

Status StyleSheets::add_rule(std::string_view selectors, const Declarations& declarations) {
    while (!selectors.empty()) {
        const std::string_view selector = trimmed(take_until(selectors, ','));
        if (!is_simple(selector)) {
            ++left_out_["style sheets' selectors other than `path`, `.class`, `#id`"];
            continue;
        }
        if (++count_ > most_selectors)
            return Error{ErrorKind::over_limit,
                         fmt::format("more than {} selectors of style sheets", most_selectors)};
        Rule& rule = rules_[std::string(selector)];
        rule.values.add(declarations);
        for (std::size_t i = 0; i < property_count; ++i)
            if (!declarations[static_cast<Property>(i)].empty()) rule.order[i] = count_;
    }
    return {};
}

struct StyleSheets::Cascade {
    Declarations values;
    std::array<std::pair<int, std::size_t>, property_count> rank{};
};

void StyleSheets::apply(const std::string& selector, int weight, Cascade& cascade) const {
    const auto rule = rules_.find(selector);
    if (rule == rules_.end()) return;
    for (std::size_t i = 0; i < property_count; ++i) {
        const auto property = static_cast<Property>(i);
        const std::pair rank{weight, rule->second.order[i]};
        if (rule->second.values[property].empty() || rank < cascade.rank[i]) continue;
        cascade.rank[i] = rank;
        cascade.values[property] = rule->second.values[property];
    }
}

Declarations StyleSheets::of(pugi::xml_node node) const {
    Declarations out;
    for (const pugi::xml_attribute attribute : node.attributes()) {
        const auto name = std::find(names.begin(), names.end(), std::string_view(attribute.name()));
        if (name == names.end()) continue;
        out[static_cast<Property>(name - names.begin())] = trimmed(attribute.value());
    }
    if (!rules_.empty()) {
        Cascade cascade;
        const std::string kind(local_name(node));
        apply("*", 0, cascade);
        apply(kind, 1, cascade);
        std::string_view classes = node.attribute("class").value();
        while (!(classes = trimmed(classes)).empty()) {
            std::size_t end = 0;
            while (end < classes.size() && !is_blank(classes[end])) ++end;
            const std::string name = "." + std::string(classes.substr(0, end));
            classes.remove_prefix(end);
            apply(name, 10, cascade);
            apply(kind + name, 11, cascade);
        }
        if (const pugi::xml_attribute id = node.attribute("id")) {
            const std::string name = std::string("#") + id.value();
            apply(name, 100, cascade);
            apply(kind + name, 101, cascade);
        }
        out.add(cascade.values);
    }
    out.add(node.attribute("style").value());
    return out;
}

Style inherited(const Declarations& declarations, Style style) {
    const auto says = [&](Property property, std::string_view value) {
        return declarations[property] == value;
    };
    const auto paints = [&](Property property, bool& is_painted) {
        const std::string_view value = declarations[property];
        if (!value.empty() && value != "inherit") is_painted = value != "none" && value != "transparent";
    };
    paints(Property::fill, style.is_filled);
    paints(Property::stroke, style.is_stroked);
    paints(Property::stroke_dasharray, style.is_dashed);
    if (says(Property::fill_rule, "evenodd")) style.rule = FillRule::even_odd;
    if (says(Property::fill_rule, "nonzero")) style.rule = FillRule::nonzero;
    if (says(Property::visibility, "visible")) style.is_visible = true;
    if (says(Property::visibility, "hidden") || says(Property::visibility, "collapse"))
        style.is_visible = false;
    if (says(Property::stroke_linejoin, "miter")) style.pen.join = Pen::Join::miter;
    if (says(Property::stroke_linejoin, "round")) style.pen.join = Pen::Join::round;
    if (says(Property::stroke_linejoin, "bevel")) style.pen.join = Pen::Join::bevel;
    if (says(Property::stroke_linecap, "butt")) style.pen.cap = Pen::Cap::butt;
    if (says(Property::stroke_linecap, "round")) style.pen.cap = Pen::Cap::round;
    if (says(Property::stroke_linecap, "square")) style.pen.cap = Pen::Cap::square;
    if (const auto limit = parse_number<double>(declarations[Property::stroke_miterlimit]);
        limit && *limit >= 1)
        style.pen.miter_limit = *limit;
    return style;
}

}  // namespace frep::reading
