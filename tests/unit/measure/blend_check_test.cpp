// Blends that change nothing, that act at a second place, whose bounding solid reaches through a wall; and
// blends that are right.
#include "frep/measure/blend_check.h"

#include <cmath>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;

namespace {

std::vector<BlendFinding> findings(const std::string& body, const Box3& box, int threads = 0) {
    BlendCheckOptions options;
    options.bounds = box;
    Job job;
    job.threads = threads;
    const auto found = check_blends(space_field_of(body), options, job);
    REQUIRE(found);
    return *found;
}

/// Two balls that meet in the circle x = 0, y^2 + z^2 = 3/4, joined where f3 > 0.
std::string two_balls(const char* f3) {
    return std::string(
               "b1 = 1 - (x[1]-0.5)^2 - x[2]^2 - x[3]^2; b2 = 1 - (x[1]+0.5)^2 - x[2]^2 - x[3]^2;\n"
               "my_model = hfBoundedBlendUni(b1, b2, ") +
           f3 + ", 0.2, 0.5, 0.5, 1);";
}

/// A rod through a plate: the surfaces meet in two circles.
constexpr const char* rod_and_plate =
    "array p[3]; array q[3]; p = [0.5, 0, 0.15]; q = [0.2, 0, 0.45];\n"
    "plate = min(0.15 - abs(x[3]), 0.9 - sqrt(x[1]^2 + x[2]^2));\n"
    "rod = min(0.2 - sqrt(x[1]^2 + x[2]^2), 0.9 - abs(x[3]));\n";

/// A plate of thickness 0.06 on a rod that ends inside it; f3 is the bounding solid of their joint below the
/// plate.
std::string table(const char* f3) {
    return std::string(
               "rho = sqrt(x[1]^2 + x[2]^2); z = x[3];\n"
               "plate = min(0.03 - abs(z), 0.9 - rho); rod = min(0.3 - rho, min(z + 0.8, -z));\n"
               "my_model = hfBoundedBlendUni(plate, rod, ") +
           f3 + ", 0.1, 0.1, 0.1, 0.2);";
}

}  // namespace

TEST_CASE("a blend that is right has no finding") {
    CHECK(findings(two_balls("0.5 - x[1]^2"), Box3::cube(2)).empty());
    CHECK(findings("b1 = 1 - (x[1]-0.5)^2 - x[2]^2 - x[3]^2; b2 = 1 - (x[1]+0.5)^2 - x[2]^2 - x[3]^2;\n"
                   "my_model = hfBlendUni(b1, b2, 0.2, 0.5, 0.5);",
                   Box3::cube(2))
              .empty());
}

TEST_CASE("a blend deep inside never acts") {
    const auto found = findings(two_balls("0.01 - (x[1]-0.5)^2 - x[2]^2 - x[3]^2"), Box3::cube(2));
    REQUIRE(found.size() == 1);
    CHECK(found[0].flaw == BlendFlaw::never_acts);
    CHECK(found[0].op == Op::bounded_uni);
    CHECK(found[0].origin.end > found[0].origin.begin);
}

TEST_CASE("a blend that a later operation removes never acts") {
    const auto found = findings(two_balls("0.5 - x[1]^2") + "\n", Box3::cube(2));
    CHECK(found.empty());
    const auto cut = findings(
        "b1 = 1 - (x[1]-0.5)^2 - x[2]^2 - x[3]^2; b2 = 1 - (x[1]+0.5)^2 - x[2]^2 - x[3]^2;\n"
        "my_model = min(hfBoundedBlendUni(b1, b2, 0.04 - x[1]^2, 0.2, 0.5, 0.5, 1), x[1] - 0.4);",
        Box3::cube(2));
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].flaw == BlendFlaw::never_acts);
}

TEST_CASE("a displacement of 0 is meant") {
    CHECK(findings("my_model = hfPointBlendUni(1-x[1]^2, 0.2-x[2]^2, 0, 1, 1);", Box3::cube(2)).empty());
}

TEST_CASE("a blend by control points that acts at a second place") {
    const auto found =
        findings(std::string(rod_and_plate) + "my_model = hfControlBlendUni(x, plate, rod, 0.1, p, q);",
                 Box3::cube(1));
    REQUIRE(found.size() == 1);
    CHECK(found[0].flaw == BlendFlaw::second_place);
    // one on each side of the plate
    CHECK(found[0].place.z * found[0].first_place.z < 0);
    CHECK(std::abs(found[0].place.z) > 0.14);
    // a bounding solid chooses one of them
    CHECK(findings(std::string(rod_and_plate) + "my_model = hfBoundedBlendUni(plate, rod, 0.4 - "
                                                "sqrt(x[1]^2+x[2]^2+(x[3]-0.3)^2), 0.1, 0.3, 0.3, 0.3);",
                   Box3::cube(1))
              .empty());
}

TEST_CASE("a bounding solid that reaches through a thin wall") {
    const auto found = findings(table("0.25 - sqrt((rho-0.3)^2 + (z+0.03)^2)"), Box3::cube(1));
    REQUIRE(found.size() == 1);
    CHECK(found[0].flaw == BlendFlaw::through_wall);
    // a bump above the plate; the joint is below it
    CHECK(found[0].place.z > 0.03);
    CHECK(found[0].place.z < 0.2);
    CHECK(found[0].first_place.z < -0.03);
    // cut with the middle of the plate it does not
    CHECK(findings(table("(0.25 - sqrt((rho-0.3)^2 + (z+0.03)^2)) & (-0.01 - z)"), Box3::cube(1)).empty());
}

TEST_CASE("the same findings for any number of threads") {
    const std::string body = two_balls("0.01 - (x[1]-0.5)^2 - x[2]^2 - x[3]^2");
    const auto one = findings(body, Box3::cube(2), 1), more = findings(body, Box3::cube(2), 3);
    REQUIRE(one.size() == more.size());
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(one[i].node == more[i].node);
}
