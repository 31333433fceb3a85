// Implementation of grid.h.
#include "frep/contour/grid.h"

#include <fmt/format.h>

#include <algorithm>

namespace frep {

namespace {

bool is_finite(double v) { return v - v == 0; }

/// Whole cells that cover `side`; a rounding error of the division adds none.
double cells_to_cover(double side, double cell) {
    const double exact = side / cell;
    if (!(exact < 2.0 * max_grid_cells)) return 2.0 * max_grid_cells;
    const double below = static_cast<double>(static_cast<std::int64_t>(exact));
    const double whole = exact - below > 1e-9 * std::max(1.0, exact) ? below + 1 : below;
    return std::max(1.0, whole);
}

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spread(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffffu;
    v = (v | v << 16) & 0x1f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    return (v | v << 2) & 0x1249249249249249u;
}

std::uint32_t gather(std::uint64_t v) {
    v &= 0x1249249249249249u;
    v = (v | v >> 2) & 0x10c30c30c30c30c3u;
    v = (v | v >> 4) & 0x100f00f00f00f00fu;
    v = (v | v >> 8) & 0x1f0000ff0000ffu;
    v = (v | v >> 16) & 0x1f00000000ffffu;
    return static_cast<std::uint32_t>((v | v >> 32) & 0x1fffff);
}

}  // namespace

Result<Grid> make_grid(const Box3& bounds, int count, double cell_length) {
    const auto wrong = [](const char* what) { return Error{ErrorKind::invalid_argument, what}; };
    const std::array<double, 3> lo{bounds.min.x, bounds.min.y, bounds.min.z};
    const std::array<double, 3> hi{bounds.max.x, bounds.max.y, bounds.max.z};
    double longest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        if (!is_finite(lo[a]) || !is_finite(hi[a]) || !is_finite(hi[a] - lo[a])) {
            return wrong("the bounds are not finite");
        }
        if (hi[a] < lo[a]) return wrong("the bounds are empty: a minimum is greater than its maximum");
        longest = std::max(longest, hi[a] - lo[a]);
    }
    if (!(longest > 0)) return wrong("the bounds have no extent");
    if (!is_finite(cell_length) || cell_length < 0) return wrong("the cell length is not a positive number");
    if (cell_length == 0 && count < 1) return wrong("the grid needs at least one cell");

    Grid grid;
    grid.cell = cell_length > 0 ? cell_length : longest / count;
    std::array<double, 3> origin{};
    for (std::size_t a = 0; a < 3; ++a) {
        const double side = hi[a] - lo[a];
        const double cells = cells_to_cover(side, grid.cell);
        if (cells > max_grid_cells) {
            return Error{ErrorKind::over_limit,
                         fmt::format("the grid would have more than {} cells along a side", max_grid_cells)};
        }
        grid.cells[a] = static_cast<std::uint32_t>(cells);
        origin[a] = lo[a] - 0.5 * (cells * grid.cell - side);
        const double end = origin[a] + cells * grid.cell;
        const double largest = std::max(std::max(origin[a], -origin[a]), std::max(end, -end));
        // An edge must hold its 40 bisection steps' worth of distinct points, at least roughly.
        if (!(largest * 1e-10 < grid.cell)) {
            return wrong("the cells are too small for coordinates this far from the origin");
        }
    }
    grid.origin = {origin[0], origin[1], origin[2]};
    return grid;
}

namespace contouring {

std::uint64_t morton_code(const std::array<std::uint32_t, 3>& block) {
    return spread(block[0]) | spread(block[1]) << 1 | spread(block[2]) << 2;
}

std::array<std::uint32_t, 3> morton_decode(std::uint64_t code) {
    return {gather(code), gather(code >> 1), gather(code >> 2)};
}

}  // namespace contouring
}  // namespace frep
