// EdgeRoots: where the surface crosses edges of the lattice, all edges of a block in a few batches. Each edge
// keeps a bracket of an inside and an outside point. A step tries the point of the secant, moved a little
// towards the middle and held so near to it that bisection never needs more than two steps less (the ITP
// method of Oliveira and Takahashi 2020, "An enhancement of the bisection method average performance
// preserving minmax optimality"). Where a value is not finite it is the middle. Every edge is searched from
// its lower to its upper end, alone: the result does not depend on the batch.
// Tested by tests/unit/contour/adaptive_roots_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/math/vec.h"

namespace frep::contouring {

/// An edge with different signs at its ends; t runs from 0 at `lower` to 1, along the axis.
struct CrossedEdge {
    Vec3 lower;
    double length = 0;  ///< coordinate of the upper end minus that of the lower
    std::uint8_t axis = 0;
    double lower_value = 0, upper_value = 0;  ///< of F; one is >= 0, the other < 0 or NaN
};

/// The bracket that was found, narrower than root_width.
struct EdgeRoot {
    double inside = 0, outside = 1;  ///< t of the ends; F >= 0 is defined at `inside`
    bool is_wall = false;            ///< F is undefined at `outside`
};

/// In edges. Beside a crease of an R-function the gradient turns within the bracket, so that a wider one
/// shows in the vertices where a pruned part has no crease.
inline constexpr double root_width = 1e-12;

class EdgeRoots {
  public:
    /// roots[i] = the crossing of edges[i].
    void find(SampledField& field, const std::vector<CrossedEdge>& edges, std::vector<EdgeRoot>& roots);

  private:
    struct Bracket {
        double low, high, low_value, high_value;
        double low_weight, high_weight;  ///< the values, as the secant takes them
    };

    std::vector<Bracket> brackets_;
    std::vector<std::uint32_t> active_;
    std::vector<double> x_, y_, z_, t_, values_;
};

/// The point at t of an edge.
Vec3 point_on(const CrossedEdge& edge, double t);

}  // namespace frep::contouring
