// automatic_bounds: a box around a shape whose bounds nobody stated (spec of `frep mesh`, "Bounds"): the old
// tools' +-10, grown by 4 while the shape reaches the box, then shrunk by interval bisection. A cube is
// subdivided only where a part that may hold the shape sticks out farthest, so a few thousand interval
// evaluations do. Tested by tests/unit/contour/bounds_test.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/sampled_field.h"
#include "frep/math/vec.h"

namespace frep {

struct BoundsOptions {
    double initial = 10;                         ///< half the side of the first cube
    double growth = 4;                           ///< each next cube is this much larger
    double largest = 1e4;                        ///< half the side of the last cube
    double margin = 0.02;                        ///< added on every side, as a share of the longest side
    std::array<bool, 3> axes{true, true, true};  ///< axes that the model uses; others stay at +-initial
    std::size_t evaluations_a_cube = 2500;       ///< interval evaluations for one cube, about
};

struct AutomaticBounds {
    Box3 box;
    bool unbounded = false;         ///< the shape reaches even the largest cube; box is the first cube
    bool empty = false;             ///< surely nothing inside the first cube; box is the first cube
    std::array<bool, 6> reaches{};  ///< unbounded: the sides -x +x -y +y -z +z that it may reach
    std::size_t evaluations = 0;    ///< interval evaluations done
};

/// A box that holds the shape {F defined and >= 0} of `field` with a margin. Errors: cancelled.
Result<AutomaticBounds> automatic_bounds(SampledField& field, const BoundsOptions& options, const Job& job);

}  // namespace frep
