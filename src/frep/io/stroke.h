// Lines with a width as areas (private to io): what a pen covers that runs along a line, with the joins and
// ends of SVG 1.1, chapter 11.4. Tested by tests/unit/io/stroke_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "frep/io/curves.h"

namespace frep::reading {

struct Pen {
    enum class Join { miter, round, bevel };
    enum class Cap { butt, round, square };

    double width = 1;
    Join join = Join::miter;
    Cap cap = Cap::butt;
    double miter_limit = 4;  ///< of a miter's length to the width; longer ones become bevels
};

/// The area that `pen` covers along the line through `line.points` (from the end to the start too where
/// `closed`), to be filled by the non-zero rule; round parts within `tolerance`. Smooth points are joined
/// round. Contours are pushed to `out` until it holds more than `most` points (counted in `count`).
///
/// Each side of the line is one run of points: parallels to the edges, with a join outside of a bend and a
/// way through the bend's own point inside. So the contours are the sum of the edges' rectangles and of the
/// joins' sectors, all of one orientation, and the winding number is 0 only where none of them is.
void append_stroke(const CurvePoints& line, bool closed, const Pen& pen, double tolerance, std::size_t most,
                   std::size_t& count, std::vector<std::vector<Vec2>>& out);

}  // namespace frep::reading
