// SVG drawings as areas: paths and basic shapes with their fills, strokes, transforms and style sheets (SVG
// 1.1, second edition). XML is read by pugixml, which knows no entities but the five of XML, so that a file
// cannot make itself larger. Tested by tests/unit/io/read_svg_test.cpp; the page: docs/outlines.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/area.h"

namespace frep {

/// An area that a file describes.
struct AreaFile {
    Area area;                       ///< y up
    std::vector<std::string> notes;  ///< what was left out, a sentence each
};

/// What a drawing paints: fills and strokes of path, rect, circle, ellipse, line, polygon, polyline; inside
/// svg, g, a, use. Each fill is a part with its own fill rule, each stroke a part. Coordinates are those of
/// the root's user space with y negated: one unit is one unit of the model, or one millimetre where the
/// root's width is in mm, cm, Q, in, pt or pc. Curves become polygons within 1/50000 of the larger side of
/// the drawing. Errors: io with "LINE:COLUMN: what is wrong" for malformed files and files where nothing is
/// painted; over_limit for ones that are too large, too deep or have too many points.
Result<AreaFile> read_svg(std::string_view bytes);

}  // namespace frep
