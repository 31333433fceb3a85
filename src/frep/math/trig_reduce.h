// Reduction of huge arguments of the trigonometric functions: one shared scalar path.
// Method: M. Payne and R. Hanek, "Radian reduction for trigonometric functions" (1983).
// Checked by tests/unit/math/kernels_test.cpp.
#pragma once

#include "frep/math/double_double.h"

FREP_MATH_OPEN

/// x = quadrant * pi/2 + (rest.hi + rest.lo) modulo 2 pi, |rest| <= pi/4 (1 + tiny).
struct ReducedAngle {
    Pair<double> rest;
    int quadrant;
};
/// For finite |x| >= 2^20; relative error of the rest below 2^-80.
ReducedAngle reduce_huge_angle(double x);

FREP_MATH_CLOSE
