// Implementation of dual_cell.h: the sheets are the polygons of cell.h for values that separate the inside
// corners of every ambiguous face.
#include "frep/contour/dual_cell.h"

#include <algorithm>

#include "frep/base/result.h"

namespace frep::contouring {

namespace {

/// The face that holds both edges; 6 when there is none.
std::size_t common_face(std::uint8_t a, std::uint8_t b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto side = [axis](std::uint8_t edge, std::size_t end) {
            return corner_offsets[edge_corners[edge][end]][axis];
        };
        const std::uint8_t s = side(a, 0);
        if (side(a, 1) == s && side(b, 0) == s && side(b, 1) == s) return 2 * axis + s;
    }
    return 6;
}

/// How the edges of a sheet lie to the planes of one normal: the least and the largest 2 n . x of their inner
/// points; `open` when that value is taken at an end only.
struct Extent {
    int low = 100, high = -100;
    bool low_is_open = true, high_is_open = true;
};

Extent extent_of(const CellPattern& pattern, std::size_t sheet, const std::array<int, 3>& normal) {
    Extent extent;
    for (std::size_t e = 0; e < 12; ++e) {
        if (pattern.sheet_of[e] != sheet) continue;
        std::array<int, 2> at{};
        for (std::size_t end = 0; end < 2; ++end) {
            const auto& offset = corner_offsets[edge_corners[e][end]];
            for (std::size_t a = 0; a < 3; ++a) at[end] += 2 * normal[a] * offset[a];
        }
        const int low = std::min(at[0], at[1]), high = std::max(at[0], at[1]);
        const bool is_open = low != high;
        if (low < extent.low) {
            extent.low = low;
            extent.low_is_open = is_open;
        } else if (low == extent.low) {
            extent.low_is_open = extent.low_is_open && is_open;
        }
        if (high > extent.high) {
            extent.high = high;
            extent.high_is_open = is_open;
        } else if (high == extent.high) {
            extent.high_is_open = extent.high_is_open && is_open;
        }
    }
    return extent;
}

/// The plane with all inner points of the edges of `sheet` strictly below and those of `other` strictly above
/// that leaves the widest gap.
SheetPlane plane_between(const CellPattern& pattern, std::size_t sheet, std::size_t other) {
    SheetPlane best;
    double widest = -1;
    for (int code = 0; code < 27; ++code) {
        const std::array<int, 3> normal{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        const int squares = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
        if (squares == 0) continue;
        const Extent below = extent_of(pattern, sheet, normal);
        const Extent above = extent_of(pattern, other, normal);
        const bool apart =
            below.high < above.low || (below.high == above.low && below.high_is_open && above.low_is_open);
        const int gap = above.low - below.high;
        const double width = static_cast<double>(gap * gap) / squares;
        if (!apart || width <= widest) continue;
        widest = width;
        for (std::size_t a = 0; a < 3; ++a) best.normal[a] = static_cast<std::int8_t>(normal[a]);
        best.twice_offset = static_cast<std::int8_t>((below.high + above.low) / 2);
    }
    FREP_CHECK(widest >= 0);  // the test goes through all patterns
    return best;
}

/// The same plane for the sheet above it.
SheetPlane turned_over(SheetPlane plane) {
    for (std::int8_t& n : plane.normal) n = static_cast<std::int8_t>(-n);
    plane.twice_offset = static_cast<std::int8_t>(-plane.twice_offset);
    return plane;
}

CellPattern make_pattern(unsigned inside) {
    std::array<double, 8> values{};
    for (unsigned i = 0; i < 8; ++i) values[i] = (inside >> i) & 1u ? 0.5 : -1.0;  // saddles below 0
    const CellPolygons polygons = trace_cell(values);
    CellPattern pattern;
    pattern.sheets = polygons.count;
    pattern.sheet_of.fill(no_sheet);
    for (auto& face : pattern.partner) face.fill(no_edge);
    std::array<int, 6> arcs{};
    std::size_t first = 0;
    for (std::uint8_t s = 0; s < polygons.count; ++s) {
        const std::size_t length = polygons.lengths[s];
        for (std::size_t k = 0; k < length; ++k) {
            const std::uint8_t a = polygons.edges[first + k];
            const std::uint8_t b = polygons.edges[first + (k + 1) % length];
            const std::size_t face = common_face(a, b);
            FREP_CHECK(face < 6);
            pattern.sheet_of[a] = s;
            pattern.edges = static_cast<std::uint16_t>(pattern.edges | 1u << a);
            pattern.partner[face][a] = b;
            pattern.partner[face][b] = a;
            ++arcs[face];
        }
        first += length;
    }
    for (std::size_t f = 0; f < 6; ++f) {
        if (arcs[f] > 1)
            pattern.ambiguous_faces = static_cast<std::uint8_t>(pattern.ambiguous_faces | 1u << f);
    }
    for (std::size_t s = 0; s < pattern.sheets; ++s) {
        std::size_t count = 0;
        for (std::size_t other = 0; other < pattern.sheets; ++other) {
            if (other == s) continue;
            pattern.planes[s][count++] =
                s < other ? plane_between(pattern, s, other) : turned_over(plane_between(pattern, other, s));
        }
    }
    return pattern;
}

}  // namespace

const std::array<CellPattern, 256>& cell_patterns() {
    static const std::array<CellPattern, 256> table = [] {
        std::array<CellPattern, 256> all;
        for (unsigned i = 0; i < 256; ++i) all[i] = make_pattern(i);
        return all;
    }();
    return table;
}

}  // namespace frep::contouring
