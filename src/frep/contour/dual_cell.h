// CellPattern: the sheets that the surface has in a cell, from the signs at its corners alone. On a face
// whose signs alternate the inside corners are always separated, so that both cells at the face agree. A
// sheet is a closed line on the cell's boundary: crossing edges, joined by arcs in faces (Nielson 2004, "Dual
// marching cubes"; here found by tracing, not from a list). Corners and edges are numbered as in cell.h; face
// 2 a + s has the normal axis a and lies on the side s, 0 low and 1 high. Tested by
// tests/unit/contour/adaptive_cell_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "frep/contour/cell.h"

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
    std::uint16_t edges = 0;                  ///< bits: edges with a crossing
    std::array<std::uint8_t, 12> sheet_of{};  ///< by edge; no_sheet: no crossing
    std::array<std::array<std::uint8_t, 12>, 6>
        partner{};  ///< [face][edge]: the other end of its arc; no_edge
    /// [sheet]: the planes towards the other sheets, sheets - 1 of them. The edges of a sheet lie on its
    /// side; none lies in the plane as a whole.
    std::array<std::array<SheetPlane, 3>, 4> planes{};

    bool is_simple() const { return sheets == 1 && ambiguous_faces == 0; }
};

/// The patterns of all signs: bit i of the index is set when corner i is inside.
const std::array<CellPattern, 256>& cell_patterns();
/// One of them. Loops do better to keep the reference to all.
inline const CellPattern& cell_pattern(unsigned inside) { return cell_patterns()[inside]; }

/// The axis of each edge of a cell.
inline constexpr std::array<std::uint8_t, 12> edge_axes = [] {
    std::array<std::uint8_t, 12> axes{};
    for (std::size_t e = 0; e < 12; ++e) {
        const auto& low = corner_offsets[edge_corners[e][0]];
        const auto& high = corner_offsets[edge_corners[e][1]];
        axes[e] = low[0] != high[0] ? 0 : low[1] != high[1] ? 1 : 2;
    }
    return axes;
}();

/// [axis][bits]: the edge along `axis` whose lower corner has the offsets of the bits (x 1, y 2, z 4).
inline constexpr std::array<std::array<std::uint8_t, 8>, 3> cell_edges_at = [] {
    std::array<std::array<std::uint8_t, 8>, 3> numbers{};
    for (std::uint8_t e = 0; e < 12; ++e) {
        const auto& low = corner_offsets[edge_corners[e][0]];
        numbers[edge_axes[e]][low[0] | low[1] << 1 | low[2] << 2] = e;
    }
    return numbers;
}();

}  // namespace frep::contouring
