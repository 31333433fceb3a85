// Which drawing formats there are and what they can hold; the writers are in write_svg.cpp and
// write_dxf.cpp. See drawing_format.h for the test.
#include "frep/io/drawing_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "frep/base/source.h"
#include "frep/io/write_drawing.h"

namespace frep {

namespace encode {

Extent extent_of(const std::vector<Polyline>& lines) {
    Extent extent;
    for (const Polyline& line : lines) {
        for (const Vec2& p : line.points) {
            if (extent.empty) extent = {p, p, false};
            extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
            extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
        }
    }
    return extent;
}

}  // namespace encode

namespace {

Error invalid(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

bool fits(double value) {
    constexpr double limit = std::numeric_limits<float>::max();
    return value >= -limit && value <= limit;
}

Status check_options(const DrawingOptions& options) {
    if (!(options.unit.metres > 0 && options.unit.metres <= 1e12)) {
        return invalid("the length of the unit is not positive and finite");
    }
    if (!(options.stroke_width > 0 && options.stroke_width <= 1e6)) {
        return invalid("the width of the stroke is not between 0 and 1e6");
    }
    if (!(options.margin >= 0 && options.margin <= 1e6)) {
        return invalid("the margin of the drawing is not between 0 and 1e6");
    }
    return {};
}

/// The lines with at least two points, in millimetres.
Result<std::vector<Polyline>> in_millimetres(const std::vector<Polyline>& lines, double scale) {
    std::vector<Polyline> scaled;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].points.size() < 2) continue;
        Polyline line = lines[i];
        for (Vec2& p : line.points) {
            p = p * scale;
            if (fits(p.x) && fits(p.y)) continue;
            return invalid(fmt::format("line {} has a coordinate that the file format cannot hold", i));
        }
        scaled.push_back(std::move(line));
    }
    return scaled;
}

}  // namespace

Result<DrawingFormat> drawing_format_from_path(std::string_view path) {
    const std::size_t slash = path.find_last_of('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const std::size_t dot = name.find_last_of('.');
    const std::string extension = lower_case(dot == std::string_view::npos ? "" : name.substr(dot));
    if (extension == ".svg") return DrawingFormat::svg;
    if (extension == ".dxf") return DrawingFormat::dxf;
    return invalid(fmt::format("'{}' has no extension of a known drawing format; known are .svg .dxf", path));
}

Result<std::string> encode_drawing(const std::vector<Polyline>& lines, DrawingFormat format,
                                   const DrawingOptions& options) {
    if (Status ok = check_options(options); !ok) return ok.error();
    const double scale = options.unit.metres == 0.001 ? 1 : options.unit.metres * 1000;
    const auto scaled = in_millimetres(lines, scale);
    if (!scaled) return scaled.error();
    return format == DrawingFormat::svg ? encode::write_svg(*scaled, options)
                                        : encode::write_dxf(*scaled, options);
}

}  // namespace frep
