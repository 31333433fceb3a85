// Tests of contour/dual_cell.h: all 256 sign patterns.
#include "frep/contour/dual_cell.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "frep/contour/cell.h"

using namespace frep::contouring;

TEST_CASE("every crossing belongs to one sheet and has an arc in each of its two faces") {
    for (unsigned inside = 0; inside < 256; ++inside) {
        CAPTURE(inside);
        const CellPattern& pattern = cell_pattern(inside);
        for (std::uint8_t e = 0; e < 12; ++e) {
            const bool crossed =
                ((inside >> edge_corners[e][0]) & 1u) != ((inside >> edge_corners[e][1]) & 1u);
            CHECK((pattern.sheet_of[e] != no_sheet) == crossed);
            int arcs = 0;
            for (std::size_t f = 0; f < 6; ++f) {
                const std::uint8_t other = pattern.partner[f][e];
                if (other == no_edge) continue;
                ++arcs;
                CHECK(pattern.partner[f][other] == e);
                CHECK(pattern.sheet_of[other] == pattern.sheet_of[e]);
            }
            CHECK(arcs == (crossed ? 2 : 0));
        }
        const bool is_mixed = inside != 0 && inside != 255;
        CHECK((pattern.sheets > 0) == is_mixed);
        CHECK(pattern.sheets <= 4);
    }
    CHECK(cell_pattern(0b00000101).sheets == 2);  // corners 0 and 2, separated on their face
    CHECK(cell_pattern(0b11111010).sheets == 1);  // their complement: one sheet
    CHECK(cell_pattern(0b01000001).sheets == 2);  // corners 0 and 6
    CHECK(cell_pattern(0b10100101).sheets == 4);  // a tetrahedron
}

TEST_CASE("two cells agree about the arcs of a common face") {
    // Corner c of the cell at x = 0 with x = 1 is the corner with x = 0 of the cell at x = 1.
    constexpr std::array<std::array<unsigned, 2>, 4> same{{{1, 0}, {2, 3}, {5, 4}, {6, 7}}};
    for (unsigned a = 0; a < 256; ++a) {
        for (unsigned b = 0; b < 256; ++b) {
            if (std::any_of(same.begin(), same.end(),
                            [&](const auto& s) { return ((a >> s[0]) & 1u) != ((b >> s[1]) & 1u); }))
                continue;
            for (std::size_t axis = 1; axis < 3; ++axis) {
                for (unsigned bits : {0u, axis == 1 ? 4u : 2u}) {
                    const std::uint8_t here = cell_edges_at[axis][bits | 1u],
                                       there = cell_edges_at[axis][bits];
                    const std::uint8_t p = cell_pattern(a).partner[1][here];
                    const std::uint8_t q = cell_pattern(b).partner[0][there];
                    REQUIRE((p == no_edge) == (q == no_edge));
                    if (p == no_edge) continue;
                    for (std::size_t end = 0; end < 2; ++end) {
                        const auto& u = corner_offsets[edge_corners[p][end]];
                        const auto& v = corner_offsets[edge_corners[q][end]];
                        REQUIRE((u[1] == v[1] && u[2] == v[2] && u[0] == 1 && v[0] == 0));
                    }
                }
            }
        }
    }
}

TEST_CASE("planes keep the sheets of a cell apart") {
    for (unsigned inside = 0; inside < 256; ++inside) {
        CAPTURE(inside);
        const CellPattern& pattern = cell_pattern(inside);
        for (std::size_t s = 0; s < pattern.sheets; ++s) {
            for (std::size_t k = 0; k + 1 < pattern.sheets; ++k) {
                const SheetPlane& plane = pattern.planes[s][k];
                const std::size_t other = k < s ? k : k + 1;
                for (std::size_t e = 0; e < 12; ++e) {
                    if (pattern.sheet_of[e] != s && pattern.sheet_of[e] != other) continue;
                    for (const double t : {1e-4, 0.5, 1 - 1e-4}) {
                        double at = 0;
                        for (std::size_t a = 0; a < 3; ++a) {
                            const double u = corner_offsets[edge_corners[e][0]][a];
                            const double v = corner_offsets[edge_corners[e][1]][a];
                            at += plane.normal[a] * (u + t * (v - u));
                        }
                        if (pattern.sheet_of[e] == s) {
                            CHECK(at < 0.5 * plane.twice_offset - 1e-5);
                        } else {
                            CHECK(at > 0.5 * plane.twice_offset + 1e-5);
                        }
                    }
                }
                // The other sheet has the same plane, turned over.
                const SheetPlane& back = pattern.planes[other][s < other ? s : s - 1];
                for (std::size_t a = 0; a < 3; ++a) CHECK(back.normal[a] == -plane.normal[a]);
                CHECK(back.twice_offset == -plane.twice_offset);
            }
        }
    }
}
