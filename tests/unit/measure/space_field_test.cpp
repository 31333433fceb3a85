// Models of n coordinates in space: coordinates replaced by axes and numbers.
#include "frep/measure/space_field.h"

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;

TEST_CASE("coordinates become axes and numbers") {
    const Field field = field_of("my_model = x[1] + 10*x[2] + 100*x[3] + 1000*x[4];", 4);
    AxisMap map;
    map.coordinates = {{2, 0}, {-1, 0.5}, {0, 0}, {2, 0}};
    const auto space = field_in_space(field, map);
    REQUIRE(space);
    CHECK(space->coordinates == 3);
    const auto evaluator = make_evaluator(*space);
    REQUIRE(evaluator);
    const double x = 2, y = 50, z = 3;
    const double* point[] = {&x, &y, &z};
    double value = 0;
    double* out[] = {&value};
    (*evaluator)->values(point, 1, out);
    CHECK(value == z + 10 * 0.5 + 100 * x + 1000 * z);
}

TEST_CASE("a map of another length is refused") {
    const auto space = field_in_space(field_of("my_model = x[1];"), AxisMap::standard(2));
    REQUIRE_FALSE(space);
    CHECK(space.error().kind == ErrorKind::invalid_argument);
}
