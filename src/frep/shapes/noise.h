// Solid noise: Gardner's sum of sines, and lattice noise with turbulence. `x` must have 3 items, else
// error_value with a warning. Frequencies are in radians (Gardner) or lattice cells (lattice noise) a unit.
// Sources: Gardner 1984; Perlin 1985. Tested by tests/unit/shapes/noise_test.cpp; kernels:
// field/kernels/noise.h.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// Product of three modulated sine series of amplitude `amp`; |value| <= (amp (1 + 1/1.17))^3.
Expression gardner(Build& build, Array x, Expression amp, Expression freq, Expression phase);

/// The same of amplitude 1 mapped to 0..1.
Expression gardner_unit(Build& build, Array x, Expression freq, Expression phase);

/// Lattice noise, smaller than 0.867 in magnitude, 0 at lattice points; one fixed table.
Expression lattice_noise(Build& build, Array x);

/// Sum of |2 noise(f x) - 1|/f over f = freq, freq/2, ... while f >= 1.
Expression turbulence(Build& build, Array x, Expression freq);

/// Gardner's noise of three expressions.
Expression gardner_series(Expression x, Expression y, Expression z, Expression amp, Expression freq,
                          Expression phase);

/// The bound of gardner_series for amplitude 1: (2.17/1.17)^3.
inline constexpr double gardner_bound = (2.17 / 1.17) * (2.17 / 1.17) * (2.17 / 1.17);

}  // namespace frep::shapes
