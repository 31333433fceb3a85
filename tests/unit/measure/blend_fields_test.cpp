#include "frep/measure/blend_fields.h"

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;
using namespace frep::measuring;

namespace {

NodeId blend_of(const Field& field) {
    for (NodeId id = 0; id < field.graph->size(); ++id)
        if (is_blend(field.graph->node(id).op)) return id;
    FAIL("no blend");
    return 0;
}

double value_at(const Field& field, double x, double y) {
    const auto evaluator = make_evaluator(field);
    REQUIRE(evaluator);
    const double z = 0;
    const double* point[] = {&x, &y, &z};
    double f = 0;
    double* out[] = {&f};
    (*evaluator)->values(point, 1, out);
    return f;
}

/// What is left of the tape of the change in a box.
bool is_idle_in(const BlendFields& fields, double low, double high) {
    const auto tape = make_clause_tape(fields.change);
    REQUIRE(tape);
    BoxLanes box;
    box.count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis][0] = axis == 0 ? low : -0.1;
        box.hi[axis][0] = axis == 0 ? high : 0.1;
    }
    Pruner pruner;
    CutResult cut;
    pruner.cut(*tape, box, Purpose::occupancy, cut);
    REQUIRE(cut.ranges.can_be_inside == 1);
    return cut.tape_of[0] >= 0 && surely_no_change(cut.tapes[0]);
}

}  // namespace

TEST_CASE("the change of a fillet in a corner, and its joint") {
    const Field field = space_field_of("my_model = hfBlendUni(-x[1], -x[2], 0.2, 1, 1);");
    const BlendFields fields = blend_fields(field, blend_of(field));
    CHECK(value_at(fields.change, 0.02, 0.02) > 0);  // added
    CHECK(value_at(fields.change, 0.9, 0.9) < 0);    // outside of both
    CHECK(value_at(fields.change, -0.1, 0.02) < 0);  // inside of both
    CHECK(value_at(fields.joint, 0, 0) == 0);
    CHECK(value_at(fields.joint, 0, 0.3) < 0);
}

TEST_CASE("where a blend within a bounding solid is off, nothing changes: proved from the cut tape") {
    // a bar along x, blended with a plate within |x| < 0.5
    const Field field = space_field_of(
        "bar = 0.05 - x[2]; plate = x[2] - 1 - x[1]^2;\n"
        "my_model = min(hfBoundedBlendUni(bar, plate, 0.5 - abs(x[1]), 0.2, 1, 1, 1), 9 - x[1]);");
    const BlendFields fields = blend_fields(field, blend_of(field));
    CHECK(is_idle_in(fields, 1, 2));
    CHECK_FALSE(is_idle_in(fields, 0, 0.3));
}
