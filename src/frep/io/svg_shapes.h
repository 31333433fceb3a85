// The shapes of SVG elements, in the element's own coordinates (private to io; SVG 1.1, chapters 8 and 9).
// Tested by tests/unit/io/read_svg_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "frep/base/result.h"
#include "frep/io/curves.h"

namespace frep::reading {

/// What is wrong with an element: in an attribute, at an offset of its value; without one, in all of it.
struct ElementError {
    pugi::xml_attribute attribute;
    std::size_t offset = 0;
    std::string message;
};

/// A length in user units from its text; `whole` is what 100% is. Nothing, or what is wrong.
std::optional<std::string> parse_svg_length(std::string_view text, double whole, double& out);

/// A length in user units: the value of `attribute`, or `missing` where it has none. `whole` is what 100% is.
std::optional<ElementError> read_length(pugi::xml_attribute attribute, double whole, double& out,
                                        double missing = 0);

/// What 100% is of a length that is neither one along x nor one along y.
double diagonal_unit(Vec2 view);

/// True for an element with a shape: path, rect, circle, ellipse, line, polygon, polyline.
bool is_shape(std::string_view name);

/// Draws an element of one of these names; `view` is what percentages are taken of.
std::optional<ElementError> draw_shape(pugi::xml_node node, std::string_view name, Vec2 view,
                                       CurveWriter& out);

}  // namespace frep::reading
