// How the elements of a drawing are painted (private to io): attributes, style sheets and `style`, in the
// order in which CSS lets one go before the other, and what is inherited. Of style sheets those selectors are
// read that name a kind of element, a class, an id, or a kind with one of these. Tested by
// tests/unit/io/svg_style_test.cpp.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "frep/base/result.h"
#include "frep/geom/area.h"
#include "frep/io/stroke.h"

namespace frep::reading {

/// The properties that are read, and then those that are only told of.
enum class Property {
    display,
    visibility,
    fill,
    fill_rule,
    stroke,
    stroke_width,
    stroke_linejoin,
    stroke_linecap,
    stroke_miterlimit,
    stroke_dasharray,
    vector_effect,
    clip_path,
    mask,
    marker,
    marker_start,
    marker_mid,
    marker_end,
};
inline constexpr std::size_t property_count = 17;
std::string_view name_of(Property property);

/// Values as written; empty where nothing says one. They point into texts that must outlive them.
class Declarations {
  public:
    std::string_view operator[](Property property) const {
        return values_[static_cast<std::size_t>(property)];
    }
    std::string_view& operator[](Property property) { return values_[static_cast<std::size_t>(property)]; }
    /// The declarations of a text `name: value; ...`, later ones over earlier ones.
    void add(std::string_view text);
    /// Those of `other` over these.
    void add(const Declarations& other);

  private:
    std::array<std::string_view, property_count> values_;
};

/// The element's name without a prefix: Inkscape's svg:path is a path.
std::string_view local_name(pugi::xml_node node);

class StyleSheets {
  public:
    /// Reads a sheet. Errors: over_limit beyond 10,000 selectors.
    Status add(std::string_view css);
    /// What attributes, sheets and `style` say of an element; later ones of these go first.
    Declarations of(pugi::xml_node node) const;
    /// Selectors and rules that were left out, each kind with its count.
    const std::map<std::string, std::size_t>& left_out() const { return left_out_; }

  private:
    /// All rules of one selector: of each property the last value, and its rule's number.
    struct Rule {
        Declarations values;
        std::array<std::size_t, property_count> order{};
    };
    /// What an element gets, with the weight and the number of the rule that said so.
    struct Cascade;

    Status add_rule(std::string_view selectors, const Declarations& declarations);
    void apply(const std::string& selector, int weight, Cascade& cascade) const;

    std::deque<std::string> texts_;
    std::map<std::string, Rule> rules_;
    std::size_t count_ = 0;
    std::map<std::string, std::size_t> left_out_;
};

/// What elements inherit.
struct Style {
    bool is_filled = true, is_stroked = false, is_visible = true, is_dashed = false;
    FillRule rule = FillRule::nonzero;
    Pen pen;
};

/// The style of an element within one of style `outer`; the width of its lines is left as it is.
Style inherited(const Declarations& declarations, Style outer);

}  // namespace frep::reading
