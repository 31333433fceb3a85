// Contours of lines and cubic Bezier curves (private to io), as SVG paths and glyphs give them, and
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
    /// At least the factor by which lengths grow; 0 only if all points go to one.
    double norm() const;
};

/// A line or a cubic from where the one before ends.
struct Segment {
    bool is_line;
    Vec2 c1, c2, to;
};

/// Filled as if closed by a line from its end to its start; a line along it is closed only where `closed`.
struct CurveContour {
    Vec2 start;
    std::vector<Segment> segments;
    bool closed = false;
};

/// The contour with each point sent through a map.
CurveContour mapped(const CurveContour& contour, const Affine& map);

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
    /// Ends the contour where it began.
    void close();
    /// A whole ellipse as a contour.
    void ellipse(Vec2 centre, double rx, double ry);

    const std::vector<CurveContour>& contours() const { return contours_; }
    /// The contours that have segments.
    std::vector<CurveContour> take();

  private:
    void add(const Segment& segment);

    Affine map_;
    Vec2 at_, start_;  ///< before the map
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

/// Points on the curves of a contour, from its start to its end, no two equal ones in a row.
struct CurvePoints {
    std::vector<Vec2> points;
    std::vector<bool> is_smooth;  ///< of each point: it lies inside a curve
};

/// Points whose joining lines stay within `tolerance` of the curves (G. Wang, The subdivision method for
/// finding the intersection between two Bezier curves or surfaces, 1984: so many pieces suffice). Stops
/// early with more than `most` points.
CurvePoints points_of(const CurveContour& contour, double tolerance, std::size_t most);

/// Polygons of the points of the contours. Those that collapse to fewer than three vertices are left out.
/// Stops early with more than `most` points altogether.
std::vector<std::vector<Vec2>> polygons_of(const std::vector<CurveContour>& contours, double tolerance,
                                           std::size_t most);

/// Curves become polygons within this part of the larger side of what they belong to.
inline constexpr double curve_tolerance = 2e-5;

/// Edges that an outline or a text may have.
inline constexpr std::size_t most_area_edges = 200'000;

}  // namespace frep::reading
