// One cubic cell of the basic polygonization algorithm: which edge nodes form which polygons, and the
// polygons as triangles. Method: Pasko, Pilyugin, Pokrovskiy 1986/1988, as the thesis describes it in 1.5.3:
// a graph of the edge nodes with branches on the six faces, hyperbolic arcs on ambiguous faces, cycles traced
// in the graph. Numbering: corners 0(000) 1(100) 2(110) 3(010) 4(001) 5(101) 6(111) 7(011), edges 0:01 1:12
// 2:23 3:30 4:45 5:56 6:67 7:74 8:04 9:15 10:26 11:37. Tested by tests/unit/contour/cell_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frep::contouring {

/// The two corners of each edge; the first is the lower one along the axis of the edge.
inline constexpr std::array<std::array<std::uint8_t, 2>, 12> edge_corners{
    {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// The offset of each corner from corner 0 along x, y, z.
inline constexpr std::array<std::array<std::uint8_t, 3>, 8> corner_offsets{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// The polygons of a cell as edge numbers, one after the other: the first has lengths[0] edges, and so on.
/// Counter-clockwise seen from outside the shape. Up to 4 polygons of together at most 12 edges.
struct CellPolygons {
    std::array<std::uint8_t, 12> edges{};
    std::array<std::uint8_t, 4> lengths{};
    std::uint8_t count = 0;
};

/// Whether on a face with inside corners a, b and outside corners c, d (a opposite b) the inside corners are
/// joined: the value of the bilinear interpolant at its saddle, the centre of the hyperbola, is >= 0. A NaN
/// among c, d separates the inside corners; infinities decide by size, equal ones join. Depends only on the
/// unordered pairs, so that both cells at the face agree.
bool face_joins_inside(double a, double b, double c, double d);

/// True when a face has inside corners in opposition, whose polygons depend on more than signs. Bit i of
/// `inside`: corner i is inside.
bool has_ambiguous_face(unsigned inside);

/// The polygons for the values at the eight corners; corner i is inside when values[i] >= 0 (NaN is outside).
CellPolygons trace_cell(const std::array<double, 8>& values);

/// True when the two edges lie on one face of the cell: their nodes must not be joined by a diagonal, because
/// the neighbour may join the same two.
bool share_face(int edge_a, int edge_b);

/// Cuts a polygon with nodes on the given `edges` into triangles of indices 0..n-1 into it, appended to
/// `triangles`. Ears are cut: the first three neighbours i, i + 1, i + 2 whose ends lie on no common face
/// lose the one in the middle. Where that ends early (some polygons of 8, all of 9 and 12 nodes) the index n
/// stands for a vertex in the middle of the polygon, and the result is true.
bool triangulate(std::span<const std::uint8_t> edges, std::vector<std::array<std::uint8_t, 3>>& triangles);

}  // namespace frep::contouring
