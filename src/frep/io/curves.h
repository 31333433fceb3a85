// Closed contours of lines and cubic Bezier curves (private to io), as SVG paths and glyphs give them, and
// their polygons. Elliptical arcs become cubics of at most 22.5 degrees, which leave the ellipse by less than
// 1e-7 of its larger semi-axis. Tested by tests/unit/io/curves_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "frep/geom/area.h"

namespace frep::reading {

/// x' = a x + c y + e, y' = b x + d y + f: the six numbers of SVG's matrix().
struct Affine {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

    Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    /// First `inner`, then this.
    Affine operator*(const Affine& inner) const;
};

/// A line or a cubic from where the one before ends.
struct Segment {
    bool is_line;
    Vec2 c1, c2, to;
};

/// Closed by a line from its end to its start.
struct CurveContour {
    Vec2 start;
    std::vector<Segment> segments;
};

/// The radii, the turn of the x-axis in degrees and the flags of an arc, as in SVG path data.
struct ArcShape {
    double rx, ry, turn;
    bool large, sweep;
};

/// Contours under construction, each point sent through a map.
class CurveWriter {
  public:
    explicit CurveWriter(const Affine& map = {}) : map_(map) {}

    /// Begins a contour.
    void move(Vec2 p);
    void line(Vec2 p);
    void quadratic(Vec2 control, Vec2 p);
    void cubic(Vec2 c1, Vec2 c2, Vec2 p);
    /// From the present point to p (SVG 1.1, F.6: radii that are too small grow, ones of 0 give a line).
    void arc(const ArcShape& shape, Vec2 p);
    /// A whole ellipse as a contour.
    void ellipse(Vec2 centre, double rx, double ry);

    const std::vector<CurveContour>& contours() const { return contours_; }
    /// The contours that have segments.
    std::vector<CurveContour> take();

  private:
    void add(const Segment& segment);

    Affine map_;
    Vec2 at_;  ///< before the map
    std::vector<CurveContour> contours_;
};

/// The box of all points and control points; min > max when there are none.
struct Box2 {
    Vec2 min{1e300, 1e300}, max{-1e300, -1e300};

    void add(Vec2 p);
    bool is_empty() const { return !(min.x <= max.x); }
    double larger_side() const;
};
Box2 box_of(const std::vector<CurveContour>& contours);

/// Polygons with vertices on the curves, whose edges stay within `tolerance` of them (G. Wang, The
/// subdivision method for finding the intersection between two Bezier curves or surfaces, 1984: so many
/// pieces suffice). Contours that collapse to fewer than three vertices are left out.
std::vector<std::vector<Vec2>> polygons_of(const std::vector<CurveContour>& contours, double tolerance);

/// Curves become polygons within this part of the larger side of what they belong to.
inline constexpr double curve_tolerance = 2e-5;

/// Edges that an outline or a text may have.
inline constexpr std::size_t most_area_edges = 200'000;

}  // namespace frep::reading
