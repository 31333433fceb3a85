// Implementation of values.h over from_chars and to_chars: independent of the locale.
#include "values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

namespace frep::cli {

namespace {

Error wrong(std::string_view text, std::string_view expected) {
    return {ErrorKind::invalid_argument, fmt::format("`{}` is not {}", text, expected)};
}

struct Unit {
    std::string_view name;
    double factor;
};

/// A number > 0 with one of the units behind it.
template <std::size_t n>
Result<double> parse_with_unit(std::string_view text, const std::array<Unit, n>& units,
                               std::string_view expected) {
    std::string_view rest = text;
    double value = 0;
    if (!take_number(rest, value) || !std::isfinite(value) || !(value > 0)) return wrong(text, expected);
    const std::string unit = lower_case(rest);
    for (const Unit& u : units)
        if (unit == u.name) return value * u.factor;
    return wrong(text, expected);
}

}  // namespace

bool take_number(std::string_view& text, double& value) {
    std::string_view digits = text;
    if (digits.starts_with('+')) {
        digits.remove_prefix(1);
        if (digits.starts_with('-')) return false;
    }
    double read = 0;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), read);
    if (end.ec == std::errc::invalid_argument) return false;
    const auto length = static_cast<std::size_t>(end.ptr - digits.data());
    if (end.ec == std::errc::result_out_of_range)
        read = std::strtod(std::string(digits.substr(0, length)).c_str(), nullptr);
    if (std::isnan(read)) return false;
    digits.remove_prefix(length);
    text = digits;
    value = read;
    return true;
}

void append_number(std::string& out, double value) {
    if (std::isnan(value)) {
        out += "undefined";
        return;
    }
    char text[32];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string number_text(double value) {
    std::string out;
    append_number(out, value);
    return out;
}

Result<double> parse_number(std::string_view text) {
    std::string_view rest = text;
    double value = 0;
    if (!take_number(rest, value) || !rest.empty()) return wrong(text, "a number");
    return value;
}

Result<double> parse_positive(std::string_view text) {
    const auto value = parse_number(text);
    if (!value || !std::isfinite(*value) || *value <= 0) return wrong(text, "a number above 0");
    return value;
}

Result<std::int64_t> parse_integer(std::string_view text, std::int64_t low, std::int64_t high) {
    std::int64_t value = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size() || value < low || value > high)
        return wrong(text, fmt::format("a whole number from {} to {}", low, high));
    return value;
}

Result<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> out;
    for (const std::string_view piece : split_at_commas(text)) {
        const auto value = parse_number(piece);
        if (!value) return value.error();
        out.push_back(*value);
    }
    return out;
}

Result<double> parse_duration(std::string_view text) {
    static constexpr std::array units = {Unit{"", 1},   Unit{"s", 1},    Unit{"ms", 1e-3},
                                         Unit{"m", 60}, Unit{"min", 60}, Unit{"h", 3600}};
    return parse_with_unit(text, units, "a time such as 10s, 500ms or 2m");
}

Result<std::size_t> parse_size(std::string_view text) {
    constexpr double k = 1024;
    static constexpr std::array units = {Unit{"", 1},
                                         Unit{"b", 1},
                                         Unit{"k", k},
                                         Unit{"kib", k},
                                         Unit{"kb", k},
                                         Unit{"m", k * k},
                                         Unit{"mib", k * k},
                                         Unit{"mb", k * k},
                                         Unit{"g", k * k * k},
                                         Unit{"gib", k * k * k},
                                         Unit{"gb", k * k * k},
                                         Unit{"t", k * k * k * k},
                                         Unit{"tib", k * k * k * k}};
    const auto bytes = parse_with_unit(text, units, "a size such as 512M or 2G");
    if (!bytes) return bytes.error();
    if (*bytes >= 9e18 || *bytes < 1) return wrong(text, "a size such as 512M or 2G");
    return static_cast<std::size_t>(*bytes);
}

Result<StatedBounds> parse_bounds(std::string_view text) {
    const auto values = parse_numbers(text);
    if (!values) return values.error();
    const std::vector<double>& v = *values;
    for (const double value : v)
        if (!std::isfinite(value)) return wrong(text, "a finite box");
    Box3 box;
    if (v.size() == 1) {
        if (!(v[0] > 0)) return wrong(text, "half the side of a cube, which is above 0");
        box = Box3::cube(v[0]);
    } else if (v.size() == 2) {
        box = {{v[0], v[0], v[0]}, {v[1], v[1], v[1]}};
    } else if (v.size() == 4) {
        box = {{v[0], v[2], -1}, {v[1], v[3], 1}};
    } else if (v.size() == 6) {
        box = {{v[0], v[2], v[4]}, {v[1], v[3], v[5]}};
    } else {
        return wrong(
            text, "1, 2, 4 or 6 numbers: v, or min,max, or ax,bx,ay,by for 2-D models, or ax,bx,ay,by,az,bz");
    }
    if (!(box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z))
        return wrong(text, "a box: every least value must be below its greatest");
    return StatedBounds{box, v.size() == 4};
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
    std::vector<std::string_view> pieces;
    while (true) {
        const std::size_t comma = text.find(',');
        std::string_view piece = text.substr(0, comma);
        while (piece.starts_with(' ')) piece.remove_prefix(1);
        while (piece.ends_with(' ')) piece.remove_suffix(1);
        pieces.push_back(piece);
        if (comma == std::string_view::npos) return pieces;
        text.remove_prefix(comma + 1);
    }
}

Status check_folder(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (path == "-" || folder.empty() || std::filesystem::is_directory(folder, error)) return {};
    return Error{ErrorKind::io,
                 fmt::format("cannot write '{}': there is no folder '{}'", path, folder.string())};
}

}  // namespace frep::cli
