// Outlines of the plane as files for cutters, plotters and CAD programs.
//   SVG  Scalable Vector Graphics 1.1 (W3C, 2011): one path, real size in millimetres, Y turned down.
//   DXF  AutoCAD drawing exchange, release 12 (AC1009), text: a POLYLINE an outline, in millimetres.
// Tested by tests/unit/io/drawing_format_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/color.h"
#include "frep/geom/polyline.h"
#include "frep/geom/scene.h"

namespace frep {

enum class DrawingFormat { svg, dxf };

/// The format that the extension of `path` names (.svg .dxf, any case). Errors: invalid_argument for another
/// or no extension.
Result<DrawingFormat> drawing_format_from_path(std::string_view path);

struct DrawingOptions {
    LengthUnit unit{"mm", 0.001};  ///< of the points
    std::string title = {};        ///< UTF-8; SVG title
    std::string description = {};  ///< UTF-8; SVG desc
    std::string layer = {};        ///< DXF layer of all outlines; "0" when empty
    /// SVG: the color inside, by the even-odd rule; nothing for outlines only. Open lines are never filled.
    std::optional<Color> fill = Color{0, 0, 0};
    std::optional<Color> stroke = {};  ///< SVG: color of the lines; black when there is no fill either
    double stroke_width = 0.1;         ///< SVG: in millimetres
    double margin = 0;                 ///< SVG: empty border around the drawing, in millimetres
};

/// The outlines as a file's bytes; none gives a valid empty drawing. A line of fewer than 2 points is left
/// out. Errors: invalid_argument for a coordinate that is not finite or beyond binary32 in millimetres, or an
/// option out of range.
Result<std::string> encode_drawing(const std::vector<Polyline>& lines, DrawingFormat format,
                                   const DrawingOptions& options = {});

}  // namespace frep
