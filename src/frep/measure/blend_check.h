// Where the blends of a model act: what each one adds to the shape, or takes away, compared with the plain
// set operation in its place. A blend is suspicious when it changes nothing, when a blend between control
// points changes a second place, and when a bounding solid reaches through a wall to a surface that the joint
// is not on (Pasko, Pasko, Ikeda and Kunii 2002, on the choice of the bounding solid). Pruned tapes find the
// cells that a blend may change, samples in them what it does change (blend_search.h). Tested by
// tests/unit/measure/blend_check_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/base/job.h"
#include "frep/base/result.h"
#include "frep/eval/evaluator.h"
#include "frep/math/vec.h"

namespace frep {

enum class BlendFlaw {
    never_acts,    ///< proved: nowhere in the box does the blend change the shape
    second_place,  ///< blends by control points and extents: the changed parts are not connected
    through_wall,  ///< bounded blends: a changed part that the joint f1 = f2 = 0 does not touch
    unseen,        ///< no sample that the blend changes was found, nor a proof that there is none
    coarse,        ///< nothing was found, with fewer samples than usual: it would have taken too long
};

struct BlendFinding {
    BlendFlaw flaw = BlendFlaw::never_acts;
    NodeId node = 0;  ///< of the field
    Op op = Op::undefined;
    Span origin;                ///< its place in the model's text
    Vec3 place;                 ///< a point that the blend changes, in the part that is unexpected
    Vec3 first_place;           ///< one in the largest part
    std::uint32_t samples = 0;  ///< along the longest side of the box
};

struct BlendCheckOptions {
    Box3 bounds;
    std::array<bool, 3> axes{true, true, true};
    EvaluatorOptions evaluator;
};

/// The findings for the blends of `field`, a field of x, y, z (field_in_space()), in the order of their
/// nodes. A blend with a displacement of 0 is not looked at. Where the shape depends on a blend through a
/// loop that depends on the point, some samples are looked at and no more. Errors: invalid_argument for an
/// empty box; those of make_evaluator(); cancelled.
Result<std::vector<BlendFinding>> check_blends(const Field& field, const BlendCheckOptions& options,
                                               const Job& job);

}  // namespace frep
