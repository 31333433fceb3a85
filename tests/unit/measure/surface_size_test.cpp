// Areas and lengths from samples, and what is said of their error.
#include "frep/measure/surface_size.h"

#include <cmath>
#include <numbers>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;

namespace {

SurfaceSize estimated(const char* body, const Box3& box, bool flat = false, int threads = 0) {
    auto evaluator = make_evaluator(space_field_of(body, flat ? 2 : 3));
    REQUIRE(evaluator);
    const auto field = make_sampled_field(std::move(*evaluator), AxisMap::standard(3));
    REQUIRE(field);
    FieldPool fields(**field);
    Job job;
    job.threads = threads;
    const auto size = estimate_surface(fields, box, {true, true, !flat}, 96, job);
    REQUIRE(size);
    return *size;
}

}  // namespace

TEST_CASE("known areas and lengths are within the estimated error") {
    constexpr double pi = std::numbers::pi;
    struct Known {
        const char* body;
        bool flat;
        double size;
    };
    for (const Known& known : {
             Known{"my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;", false, 4 * pi},
             Known{"my_model = 1 - sqrt(x[1]^2 + x[2]^2 + x[3]^2);", false, 4 * pi},
             Known{"array c[3]; c = [0,0,0]; my_model = hfTorusZ(x, c, 0.8, 0.3);", false,
                   4 * pi * pi * 0.24},
             Known{"my_model = min(min(0.71-abs(x[1]), 0.37-abs(x[2])), 0.53-abs(x[3]));", false,
                   8 * (0.71 * 0.37 + 0.71 * 0.53 + 0.37 * 0.53)},
             Known{"my_model = 1 - x[1]^2 - x[2]^2;", true, 2 * pi},
             Known{"my_model = min(0.7-abs(x[1]), 0.4-abs(x[2]));", true, 4.4},
         }) {
        CAPTURE(known.body);
        const SurfaceSize found = estimated(known.body, Box3::cube(1.23), known.flat);
        CHECK(std::abs(found.size - known.size) <= 1.5 * found.error);
        CHECK(found.error < 0.03 * known.size);
    }
}

TEST_CASE("the same bits for any number of threads") {
    const char* body = "my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;";
    const SurfaceSize one = estimated(body, Box3::cube(1.2), false, 1),
                      more = estimated(body, Box3::cube(1.2), false, 3);
    CHECK(one.size == more.size);
    CHECK(one.error == more.error);
}

TEST_CASE("a surface that ends where F does is closed half way") {
    // the half disk x >= 0 of sqrt(x) + 1 - ...: inside everywhere it is defined; the wall is x = 0
    const SurfaceSize wall = estimated("my_model = sqrt(x[1]) + 1;", {{-1, -1, 0}, {1, 1, 0}}, true);
    CHECK(wall.size == doctest::Approx(2).epsilon(1e-9));
}
