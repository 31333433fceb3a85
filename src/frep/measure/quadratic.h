// Piecewise linear bounds of a function on a cell, from its jet or from quadratic bounds. Used by
// cell_bounds.cpp. Tested by tests/unit/measure/cell_bounds_test.cpp.
#pragma once

#include "frep/measure/cell_bounds.h"

namespace frep::measuring {

/// The function's quadratic bounds from its jets over a cell and at its middle; nothing where the numbers are
/// too large or the function may be undefined.
std::optional<Quadratic> quadratic_of(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole,
                                      const Jet& middle);

/// How far the piecewise linear bounds of quadratic ones are apart in a cell, in the mean.
struct QuadraticGap {
    double rest = 0;  ///< what the rest R adds
    double bend = 0;  ///< what the lines miss of the curves
};
QuadraticGap gap_of(const Quadratic& q, const Cell& cell, std::span<const std::size_t> axes);
/// The same of mean value bounds; infinite where there are none.
double mean_value_gap(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole);

/// Sets has_planes, lower, upper and gap of `out`, and the sign where they prove it. `cell` is a part of the
/// cell that q was made for.
void set_quadratic_bounds(const Quadratic& q, const Cell& cell, std::span<const std::size_t> axes,
                          CellBounds& out);
void set_mean_value_bounds(const Cell& cell, std::span<const std::size_t> axes, const Jet& whole,
                           const Jet& middle, CellBounds& out);

}  // namespace frep::measuring
