// Reading the values of options from text: numbers, lists, durations, sizes. Errors are one sentence that
// quotes the text; the caller puts the option's name before it. Tested by tests/cli.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frep/frep.h"

namespace frep::cli {

/// Reads a decimal number at the start of `text` and removes it from there. A leading + is allowed, `inf` and
/// `infinity` are numbers, `nan` is not. Numbers beyond the range of double become infinite or 0. False when
/// there is none; `text` then stays.
bool take_number(std::string_view& text, double& value);

/// The shortest decimal that reads back to the same double: `inf`, `-inf`; NaN gives `undefined`.
void append_number(std::string& out, double value);
std::string number_text(double value);

Result<double> parse_number(std::string_view text);
/// A number that is finite and > 0.
Result<double> parse_positive(std::string_view text);
/// A whole number from `low` to `high`.
Result<std::int64_t> parse_integer(std::string_view text, std::int64_t low, std::int64_t high);
/// Numbers separated by commas, at least one.
Result<std::vector<double>> parse_numbers(std::string_view text);
/// `10`, `10s`, `500ms`, `2m`, `1h`: seconds, > 0.
Result<double> parse_duration(std::string_view text);
/// `1000000`, `512M`, `2G`, `2GiB`: bytes (K, M, G, T are powers of 1024), > 0.
Result<std::size_t> parse_size(std::string_view text);
/// What `--bounds` says: a box of space, or a rectangle for models of the plane.
struct StatedBounds {
    Box3 box;
    bool is_flat = false;  ///< a rectangle: x and y of the box are the plane's two axes, z counts for nothing
};
/// `v` (the cube of half side v), `min,max` (all axes), `ax,bx,ay,by` or `ax,bx,ay,by,az,bz`.
Result<StatedBounds> parse_bounds(std::string_view text);

/// The folder of an output file must be there before the work begins; `-` needs none. Errors: io.
Status check_folder(const std::string& path);

/// The pieces of `text` between commas. They point into `text`, so a string that dies at once is refused.
std::vector<std::string_view> split_at_commas(std::string_view text);
std::vector<std::string_view> split_at_commas(std::string&& text) = delete;

}  // namespace frep::cli
