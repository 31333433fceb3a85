// Interpolation by radial functions: a linear polynomial and a sum of w r^3 over the given points, in up to
// four coordinates, of which the last may be time. r^3 is conditionally positive definite of order 2 in every
// dimension, so that with a linear polynomial the weights are unique (Duchon 1977; Turk and O'Brien 1999).
// They solve a dense linear system, by Gaussian elimination in a fixed order, so that the same points give
// the same bits on every machine. Tested by tests/unit/shapes/radial_test.cpp; kernel:
// field/kernels/radial.h.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "frep/shapes/library.h"

namespace frep::shapes {

using RadialPoint = std::array<double, 4>;

/// Values at points: one or more columns over the same points.
struct RadialProblem {
    std::array<bool, 4> used{};  ///< the coordinates that count; the others must be 0 everywhere
    std::vector<RadialPoint> points;
    std::vector<std::vector<double>> values;  ///< for each function its values, one a point
};

/// The functions as data of Op::radial_cubic; or what is wrong.
struct RadialFit {
    std::vector<std::vector<double>> sums;
    std::string problem;  ///< empty when all is well
};

/// Points of one problem at most: the system grows with their square, the work with their cube.
inline constexpr std::size_t most_radial_points = 1500;

/// The functions that take the values at the points. Points nearer to one before than 1e-7 of their extent
/// are left out. Where all points lie in a line or a plane, slopes across it are 0. Problems: no points, more
/// than most_radial_points, numbers that are not finite.
RadialFit fit_radial(const RadialProblem& problem);

/// The function at a place.
Expression radial_sum(Build& build, const std::array<Expression, 4>& place, const std::vector<double>& sum);

}  // namespace frep::shapes
