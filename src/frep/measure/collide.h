// Do two shapes have points in common? Branch and bound on min(fA, fB), which is >= 0 in the common part (a
// set operation of functions; bounds by intervals and mean value forms, cell_bounds.h): "apart" is a proof,
// "collide" comes with a point inside both. Tested by tests/unit/measure/collide_test.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/evaluator.h"
#include "frep/math/vec.h"

namespace frep {

enum class Collision {
    apart,     ///< surely no common point in the box
    touching,  ///< neither a point inside both was found, nor a proof that there is none, in cells of `cell`
    collide,   ///< both functions are > 0 at the witness
};

struct CollideOptions {
    Box3 bounds;
    std::array<bool, 3> axes{true, true, true};  ///< those that the shapes have
    double tolerance = 1e-6;         ///< cells no longer than this, in model units, are not divided any more
    std::size_t max_cells = 20'000;  ///< undecided cells held at a time
    EvaluatorOptions evaluator;
};

struct CollideResult {
    Collision kind = Collision::apart;
    Vec3 witness;      ///< the best point found; the middle of an undecided cell where they touch
    double depth = 0;  ///< min(fA, fB) there
    double cell = 0;   ///< touching: the longest side of the cells that are left
    bool is_cancelled = false;
    std::size_t evaluated = 0;  ///< cells looked at
};

/// `a` and `b` are fields of x, y, z (field_in_space()). The same bytes for any number of threads. Errors:
/// invalid_argument for an empty box or a tolerance that is not > 0; over_limit, those of make_evaluator().
Result<CollideResult> collide(const Field& a, const Field& b, const CollideOptions& options, const Job& job);

}  // namespace frep
