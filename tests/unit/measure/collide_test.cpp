// Pairs of shapes that have points in common, are apart, or touch.
#include "frep/measure/collide.h"

#include <cmath>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;

namespace {

CollideResult collided(const std::string& a, const std::string& b, double tolerance = 1e-6) {
    CollideOptions options;
    options.bounds = Box3::cube(4);
    options.tolerance = tolerance;
    const auto result = collide(space_field_of(a), space_field_of(b), options, {});
    if (!result) FAIL(result.error().message);
    return *result;
}

std::string ball(double x, double r) {
    return "my_model = " + std::to_string(r * r) + " - (x[1] - (" + std::to_string(x) +
           "))^2 - x[2]^2 - x[3]^2;";
}

}  // namespace

TEST_CASE("balls that overlap, with a point inside both") {
    const CollideResult r = collided(ball(0, 1), ball(1.9, 1));
    CHECK(r.kind == Collision::collide);
    const auto inside = [&](double x) { return std::hypot(r.witness.x - x, r.witness.y, r.witness.z) < 1; };
    CHECK(inside(0));
    CHECK(inside(1.9));
    // the least of the two functions is greatest in the middle: 1 - 0.95^2
    CHECK(r.depth > 0);
    CHECK(r.depth <= 1 - 0.95 * 0.95 + 1e-12);
}

TEST_CASE("a small overlap is found") {
    const CollideResult r = collided(ball(0, 1), ball(1.9999, 1));
    CHECK(r.kind == Collision::collide);
    CHECK(std::abs(r.witness.x - 0.99995) < 1e-4);
}

TEST_CASE("balls that are apart, however little") {
    for (const double gap : {1.0, 0.1, 1e-4}) {
        CAPTURE(gap);
        CHECK(collided(ball(0, 1), ball(2 + gap, 1)).kind == Collision::apart);
    }
}

TEST_CASE("balls that touch in a point") {
    const CollideResult r = collided(ball(0, 1), ball(2, 1), 1e-4);
    CHECK(r.kind == Collision::touching);
    CHECK(r.cell <= 1e-4);
    CHECK(std::abs(r.witness.x - 1) < 0.02);
}

TEST_CASE("one shape inside the other, and nothing") {
    CHECK(collided(ball(0, 2), ball(0.3, 0.1)).kind == Collision::collide);
    const CollideResult none = collided(ball(0, 2), "my_model = -1 - x[1]^2;");
    CHECK(none.kind == Collision::apart);
    // undefined is outside
    CHECK(collided(ball(0, 2), "my_model = sqrt(-1 - x[1]^2);").kind == Collision::apart);
}

TEST_CASE("the same answer for any number of threads") {
    const Field a = space_field_of("array c[3]; c = [0,0,0]; my_model = hfTorusZ(x, c, 1, 0.3);");
    const Field b = space_field_of("my_model = 0.09 - (x[1]-1.55)^2 - x[2]^2 - (x[3]-0.1)^2;");
    CollideOptions options;
    options.bounds = Box3::cube(2);
    const auto with = [&](int threads) {
        Job job;
        job.threads = threads;
        const auto found = collide(a, b, options, job);
        REQUIRE(found);
        return *found;
    };
    const CollideResult one = with(1);
    CHECK(one.kind == Collision::collide);
    for (const int threads : {2, 5}) {
        const CollideResult other = with(threads);
        CHECK(other.witness == one.witness);
        CHECK(other.depth == one.depth);
        CHECK(other.evaluated == one.evaluated);
    }
}

TEST_CASE("wrong boxes are refused") {
    CollideOptions options;
    options.bounds = {{0, 0, 0}, {0, 1, 1}};
    CHECK_FALSE(collide(space_field_of(ball(0, 1)), space_field_of(ball(0, 1)), options, {}));
}
