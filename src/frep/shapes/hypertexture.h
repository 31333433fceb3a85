// Hypertexture: solid noise added to the function of any solid, everywhere or only near its surface (Perlin
// and Hoffert 1989). Tested by tests/unit/shapes/hypertexture_test.cpp.
#pragma once

#include "frep/shapes/library.h"

namespace frep::shapes {

/// f + amplitude w(f) sum over k < octaves of noise(2^k frequency x + o_k)/2^k, with lattice noise and
/// offsets o_k = k (0.31, 0.57, 0.83), so that the octaves are not 0 at the same points. w(f) = (1 -
/// (f/falloff)^2)^3 where |f| < falloff, else 0; a falloff of 0 or less means w = 1. `octaves` must be
/// known, 1..12.
Expression hypertexture(Build& build, Array x, Expression f, Expression amplitude, Expression frequency,
                        Expression octaves, Expression falloff);

}  // namespace frep::shapes
