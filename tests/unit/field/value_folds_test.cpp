// Tests of field/value_folds.h: which uses of a fold need its values.
#include "frep/field/value_folds.h"

#include <doctest/doctest.h>

#include <memory>

#include "frep/field/expression.h"

using namespace frep;

namespace {

struct Fixture {
    std::shared_ptr<Graph> graph = std::make_shared<Graph>();
    Expression x{*graph, graph->coordinate(0)}, y{*graph, graph->coordinate(1)};

    /// A union of `count` discs, the second one taken away.
    Expression fold(int count) const {
        Expression f = 1.0 - square(x) - square(y);
        for (int i = 1; i < count; ++i) {
            const Expression disc = 1.0 - square(x - i) - square(y);
            f = i == 1 ? r_and(f, -disc) : r_or(f, disc);
        }
        return f;
    }
    std::vector<ValueFold> found(Expression value) const {
        Field field;
        field.graph = graph;
        field.value = value.id();
        field.coordinates = 2;
        return value_folds(field, 4);
    }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "folds whose sign alone matters are left in peace") {
    CHECK(found(fold(9)).empty());
    CHECK(found(-fold(9)).empty());
    CHECK(found(2.0 * fold(9)).empty());
    CHECK(found(fold(9) / 3.0).empty());
    CHECK(found(min(fold(9), x)).empty());
    CHECK(found(r_and(-fold(9), y)).empty());
}

TEST_CASE_FIXTURE(Fixture, "folds whose values matter are found once, with their operands") {
    for (const Expression value : {fold(9) + 0.1, 0.1 - abs(fold(9)), fold(9) * x, min(x, fold(9) - y),
                                   2.0 / fold(9), fold(9) * 0.0}) {
        const auto folds = found(value);
        REQUIRE(folds.size() == 1);
        CHECK(folds[0].operands == 9);
        CHECK(folds[0].node == fold(9).id());
    }
    const Expression f1 = fold(6), f2 = r_or(x, -r_or(y, -fold(5)));
    const auto folds = found(apply(Op::blend_uni, {f1, f2, f1 * 0.0 + 1.0, x, y}));
    REQUIRE(folds.size() == 2);
    CHECK(folds[0].operands == 6);
    CHECK(folds[1].operands == 7);
}

TEST_CASE_FIXTURE(Fixture, "short folds are left in peace") {
    CHECK(found(fold(3) + 0.1).empty());
    CHECK(found(fold(4) + 0.1).size() == 1);
}
