// The functions that tell what one blend of a model does. Tested by
// tests/unit/measure/blend_fields_test.cpp.
#pragma once

#include "frep/eval/clause_tape.h"
#include "frep/field/field.h"

namespace frep::measuring {

struct BlendFields {
    /// min(max(F, P), -min(F, P)) with P the model with the plain set operation in place of the blend: > 0
    /// where one of the two is > 0 and the other < 0, that is where the blend changes the shape.
    Field change;
    /// -max(|f1|, |f2|) of the blended operands: >= 0 on the joint f1 = f2 = 0 alone.
    Field joint;
};

/// True for an operation that blends two operands.
bool is_blend(Op op);
/// True for a blend within a bounding solid.
bool is_bounded_blend(Op op);
/// True for a blend by control points, or by extents.
bool is_point_blend(Op op);

/// The functions of the blend at node `blend` of `field`, fields of the same coordinates.
BlendFields blend_fields(const Field& field, NodeId blend);

/// True where a tape that was cut from that of BlendFields::change for a box proves that nothing changes
/// there: what is left of F and P is the same.
bool surely_no_change(const ClauseTape& tape);

}  // namespace frep::measuring
