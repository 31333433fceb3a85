// The text form of points and boxes, one a line (docs/cli.md, eval). Tested by tests/cli.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frep::cli {

/// What a line holds.
struct LineContent {
    std::vector<double> numbers;  ///< coordinates; for boxes lo hi lo hi ...
    bool is_blank = false;        ///< nothing but blanks
    bool is_comment = false;      ///< begins with #
    std::string error;            ///< what is wrong with a malformed line; empty if nothing is
    std::size_t column = 1;       ///< of the mistake, in code points from 1
};

/// Coordinates separated by blanks or by commas.
void parse_point(std::string_view line, LineContent& out);

/// Pairs lo,hi separated by blanks.
void parse_box(std::string_view line, LineContent& out);

}  // namespace frep::cli
