// The part of a cell where a piecewise linear function is positive: its share of the cell and its moments.
// The cell is cut into D! simplices along its diagonal (Kuhn 1960); in each the function is linear, given by
// its values at the corners, and the part is a sum of simplices whose sizes are products of positive numbers,
// so that nothing cancels. Tested by tests/unit/measure/clip_test.cpp.
#pragma once

#include <array>
#include <span>

namespace frep::measuring {

/// Integrals over a part of the cube [-1,1]^D, divided by the size of the cube.
struct PartMoments {
    double share = 0;                ///< of 1
    std::array<double, 3> first{};   ///< of u_i
    std::array<double, 6> second{};  ///< of u_0 u_0, u_1 u_1, u_2 u_2, u_0 u_1, u_0 u_2, u_1 u_2
};

/// Every number of positive_part() is within this of the exact one: it is a sum of at most 24 products of at
/// most 6 factors below 1, each within 2^-51 of its own, and a weight.
inline constexpr double clip_error = 0x1p-44;

/// Moments of the part of the cube of `dimension` (2 or 3) where the function with these values at the
/// corners is > 0; bit i of a corner's number is its side along axis i. Values must be finite, below 1e150 in
/// size.
PartMoments positive_part(int dimension, std::span<const double> corners);

/// The same for a function with these values on the lattice 3^D of the coordinates -1, 0, 1, linear in the
/// simplices of each of the 2^D parts between them; digit k of a point's number to the base 3 is its place
/// along axis k.
PartMoments positive_part_of_lattice(int dimension, std::span<const double> points);
/// Its share alone, in half the time.
double positive_share_of_lattice(int dimension, std::span<const double> points);

}  // namespace frep::measuring
