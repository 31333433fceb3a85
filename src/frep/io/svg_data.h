// The small languages inside SVG attributes (private to io): path data, transforms, lists of numbers, lengths
// (SVG 1.1, chapters 4.2, 7.6 and 8.3). An error names its offset in the attribute. Tested by
// tests/unit/io/svg_data_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/io/curves.h"

namespace frep::reading {

/// What is wrong in an attribute, and where.
struct DataError {
    std::size_t offset;
    std::string message;
};

/// Draws path data, all commands MmLlHhVvCcSsQqTtAaZz. A first moveto is asked for; numbers follow in any
/// number of sets; a path that goes on after a Z begins again at the contour's start.
std::optional<DataError> draw_path(std::string_view data, CurveWriter& out);

/// matrix, translate, scale, rotate, skewX, skewY in any number, the first one outermost.
std::optional<DataError> parse_transform(std::string_view text, Affine& out);

/// Numbers apart by blanks and commas.
std::optional<DataError> parse_numbers(std::string_view text, std::vector<double>& out);

/// A number with its unit: "" for user units, "%", "mm", ...
struct SvgLength {
    double number = 0;
    std::string_view unit;
};
std::optional<SvgLength> parse_length(std::string_view text);

/// How many millimetres an absolute unit of CSS has (mm, cm, Q, in, pt, pc); px counts 25.4/96.
std::optional<double> millimetres(std::string_view unit);

}  // namespace frep::reading
