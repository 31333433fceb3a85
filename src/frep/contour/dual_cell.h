// CellPattern: the sheets that the surface has in a cell, from the signs at its corners alone. On a face
// whose signs alternate the inside corners are always separated, so that both cells at the face agree. A
// sheet is a closed line on the cell's boundary: crossing edges, joined by arcs in faces (Nielson 2004, "Dual
// marching cubes"; here found by tracing, not from a list). Corners and edges are numbered as in cell.h; face
// 2 a + s has the normal axis a and lies on the side s, 0 low and 1 high. Tested by
// tests/unit/contour/adaptive_cell_test.cpp.
#pragma once

#include <array>
#include <cstdint>

namespace frep::contouring {

inline constexpr std::uint8_t no_sheet = 255;
inline constexpr std::uint8_t no_edge = 255;

/// A plane that keeps two sheets of a cell apart: normal . x * 2 = twice_offset, in the unit cell. The sheet
/// that it belongs to lies where the left side is smaller.
struct SheetPlane {
    std::array<std::int8_t, 3> normal{};
    std::int8_t twice_offset = 0;
};

struct CellPattern {
    std::uint8_t sheets = 0;                  ///< 0 to 4
    std::uint8_t ambiguous_faces = 0;         ///< bits: faces with two arcs
    std::array<std::uint8_t, 12> sheet_of{};  ///< by edge; no_sheet: no crossing
    std::array<std::array<std::uint8_t, 12>, 6>
        partner{};  ///< [face][edge]: the other end of its arc; no_edge
    /// [sheet]: the planes towards the other sheets, sheets - 1 of them. The edges of a sheet lie on its
    /// side; none lies in the plane as a whole.
    std::array<std::array<SheetPlane, 3>, 4> planes{};

    bool is_simple() const { return sheets == 1 && ambiguous_faces == 0; }
};

/// The pattern of the signs `inside`: bit i is set when corner i is inside.
const CellPattern& cell_pattern(unsigned inside);

/// The edge along `axis` whose lower corner has the offsets of the bits (x 1, y 2, z 4) from corner 0.
std::uint8_t cell_edge_at(std::size_t axis, unsigned lower_bits);

}  // namespace frep::contouring
