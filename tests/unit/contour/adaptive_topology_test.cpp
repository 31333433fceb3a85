// Solids that are hard to mesh, through contour_adaptive: each has its true topology stated (shells and Euler
// characteristic, hence the genus), and every mesh must be sound. Where a solid touches itself in a point or
// a line the set F >= 0 is no manifold; both ways to part it are then right. What is thinner than a cell may
// be lost where no sample meets it: then the result must tell so. Set operations are tried as min and max and
// as R-functions.
#include <doctest/doctest.h>

#include <string>

#include "frep/math/rfunctions.h"
#include "unit/contour/adaptive_checks.h"

using namespace frep;
using namespace frep::test;

namespace {

using std::abs;

/// Which set operations the solids are made of; try_all() sets it.
bool by_r_functions = false;

double min(double a, double b) { return by_r_functions ? math::r_and(a, b) : std::min(a, b); }
double max(double a, double b) { return by_r_functions ? math::r_or(a, b) : std::max(a, b); }

struct Topology {
    std::size_t shells;
    std::int64_t euler;
    bool operator==(const Topology&) const = default;
};

struct Case {
    const char* name;
    FunctionField::Value f;
    std::vector<Topology> right;
    int cells = 16;  ///< on [-1, 1]^3: cells of 1/8
    bool cap = false;
    std::vector<Topology> if_told{};  ///< for a result that tells of thin parts, or is empty
};

double ball(double x, double y, double z, double r) { return r * r - x * x - y * y - z * z; }
double box(double x, double y, double z, double a, double b, double c) {
    return min(a - abs(x), min(b - abs(y), c - abs(z)));
}
/// The box from p to q.
double between(double x, double y, double z, Vec3 p, Vec3 q) {
    return min(min(min(x - p.x, q.x - x), min(y - p.y, q.y - y)), min(z - p.z, q.z - z));
}

constexpr double h = 0.125;
const Topology one_ball{1, 2}, two_balls{2, 4}, nothing{0, 0};

std::vector<Case> touching() {
    return {
        {"spheres tangent at a lattice point",
         [](double x, double y, double z) { return max(ball(x - 0.4, y, z, 0.4), ball(x + 0.4, y, z, 0.4)); },
         {two_balls, one_ball},
         20},
        {"spheres tangent off the lattice",
         [](double x, double y, double z) {
             return max(ball(x - 0.43, y - .01, z, 0.4), ball(x + 0.37, y - .01, z, 0.4));
         },
         {two_balls, one_ball}},
        {"spheres tangent along a diagonal",
         [](double x, double y, double z) {
             const double d = 0.4 / std::sqrt(3.0);
             return max(ball(x - d, y - d, z - d, 0.4), ball(x + d, y + d, z + d, 0.4));
         },
         {two_balls, one_ball}},
        {"spheres closer than a cell",
         [](double x, double y, double z) {
             return max(ball(x - 0.46, y, z, 0.4), ball(x + 0.46, y, z, 0.4));
         },
         {two_balls, one_ball},
         20},
        {"cavities closer than a cell",
         [](double x, double y, double z) {
             return min(ball(x, y, z, 0.95), -max(ball(x - .42, y, z, 0.4), ball(x + .42, y, z, 0.4)));
         },
         {{3, 6}, {2, 4}},
         20},
        {"boxes sharing a face on the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.25, -.25}, {0, .25, .25}),
                        between(x, y, z, {0, -.25, -.25}, {.5, .25, .25}));
         },
         {one_ball}},
        {"boxes sharing a face off the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.3, -.3}, {.03, .3, .3}),
                        between(x, y, z, {.03, -.3, -.3}, {.5, .3, .3}));
         },
         {one_ball}},
        {"boxes sharing an edge on the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.5, -.25}, {0, 0, .25}),
                        between(x, y, z, {0, 0, -.25}, {.5, .5, .25}));
         },
         {two_balls, one_ball}},
        {"boxes sharing an edge off the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.5, -.3}, {.03, .04, .3}),
                        between(x, y, z, {.03, .04, -.3}, {.5, .5, .3}));
         },
         {two_balls, one_ball}},
        {"boxes sharing a vertex on the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.5, -.5}, {0, 0, 0}),
                        between(x, y, z, {0, 0, 0}, {.5, .5, .5}));
         },
         {two_balls, one_ball}},
        {"boxes sharing a vertex off the lattice",
         [](double x, double y, double z) {
             return max(between(x, y, z, {-.5, -.5, -.5}, {.02, .03, .04}),
                        between(x, y, z, {.02, .03, .04}, {.5, .5, .5}));
         },
         {two_balls, one_ball}},
        {"four cubes of a chessboard, off the lattice",
         [](double x, double y, double z) {
             return min(box(x, y, z, .6, .6, .6), (x - .03) * (y - .04) * (z - .02));
         },
         {{4, 8}, one_ball}},
        {"four cubes of a chessboard, on the lattice",
         [](double x, double y, double z) { return min(box(x, y, z, .5, .5, .5), x * y * z); },
         {{4, 8}, one_ball}},
        {"a double cone, apex on the lattice",
         [](double x, double y, double z) { return min(z * z - x * x - y * y, 0.6 - abs(z)); },
         {two_balls, one_ball}},
        {"a double cone, apex off the lattice",
         [](double x, double y, double z) {
             return min((z - .03) * (z - .03) - (x - .02) * (x - .02) - y * y, 0.6 - abs(z));
         },
         {two_balls, one_ball}},
        {"a pocket whose lid has no thickness",
         [](double x, double y, double z) {
             return min(box(x, y, z, .5, .5, .5), -between(x, y, z, {-.25, -.25, 0}, {.25, .25, .5}));
         },
         {two_balls}},
    };
}

std::vector<Case> thin() {
    return {
        {"a wall thinner than a cell, on the lattice",
         [](double x, double y, double z) { return box(x, y, z, .03, .5, .6); },
         {one_ball}},
        {"a wall thinner than a cell between samples: lost",
         [](double x, double y, double z) { return box(x - .06, y, z, .03, .5, .6); },
         {one_ball},
         16,
         false,
         {nothing}},
        {"a gap thinner than a cell between samples: closed",
         [](double x, double y, double z) {
             return min(box(x, y, z, .7, .5, .6), abs(.96 * (x - .06) + .28 * y) - .002);
         },
         {two_balls},
         16,
         false,
         {one_ball}},
        {"a wall thinner than a cell, tilted: parted where it slips between samples",
         [](double x, double y, double z) {
             return box(.96 * x + .28 * y, .96 * y - .28 * x, z, .03, .7, .6);
         },
         {one_ball},
         32,
         false,
         {{7, 14}}},
        {"a wall of two cells, tilted",
         [](double x, double y, double z) {
             return box(.96 * x + .28 * y, .96 * y - .28 * x, z, .03, .7, .6);
         },
         {one_ball},
         64},
        {"a wall of exactly one cell between lattice planes",
         [](double x, double y, double z) { return box(x - h / 2, y, z, h / 2, .5, .6); },
         {one_ball}},
        {"a needle",
         [](double x, double y, double z) { return min(.05 * (z + .8) - std::hypot(x, y), .8 - z); },
         {one_ball}},
        {"three rods through each other",
         [](double x, double y, double z) {
             return max(max(box(x, y, z, .8, .07, .07), box(x, y, z, .07, .8, .07)),
                        box(x, y, z, .07, .07, .8));
         },
         {one_ball}},
        {"a thin torus",
         [](double x, double y, double z) {
             const double d = std::hypot(x, y) - 0.7;
             return 0.14 * 0.14 - d * d - z * z;
         },
         {{1, 0}}},
        {"an acute wedge across cells",
         [](double x, double y, double z) {
             return min(min(min(.1 * x - y, y + .1 * x), .7 - x), .5 - abs(z));
         },
         {one_ball},
         20},
        {"an acute wedge turned",
         [](double x, double y, double z) {
             const double u = .8 * x + .6 * z, w = .8 * z - .6 * x;
             return min(min(min(.15 * u - y + .043, y + .15 * u), .6 - u), .5 - abs(w));
         },
         {one_ball},
         24},
    };
}

std::vector<Case> on_the_lattice() {
    return {
        {"a sphere through lattice points",
         [](double x, double y, double z) { return ball(x, y, z, .5); },
         {one_ball}},
        {"a sphere between lattice points",
         [](double x, double y, double z) { return ball(x - .061, y + .043, z - .02, .53); },
         {one_ball}},
        {"a box on lattice planes",
         [](double x, double y, double z) { return box(x, y, z, .5, .5, .5); },
         {one_ball}},
        {"a box inside of lattice planes by 1e-12",
         [](double x, double y, double z) { return box(x, y, z, .5 - 1e-12, .5 - 1e-12, .5 - 1e-12); },
         {one_ball}},
        {"an octahedron with its corners on the lattice",
         [](double x, double y, double z) { return .5 - abs(x) - abs(y) - abs(z); },
         {one_ball}},
        {"a box turned by 45 degrees through lattice points",
         [](double x, double y, double z) { return .5 - max(max(abs(x + y), abs(x - y)), abs(z)); },
         {one_ball}},
        {"a pyramid with its apex on the lattice",
         [](double x, double y, double z) { return min(.5 - max(abs(x), abs(y)) - z, z + .25); },
         {one_ball}},
        {"a cone with its apex on the lattice",
         [](double x, double y, double z) { return min(.5 - std::hypot(x, y) - z, z + .25); },
         {one_ball}},
        {"a sphere in a grid of two cells",
         [](double x, double y, double z) { return ball(x, y, z, .5); },
         {one_ball},
         2},
        {"a sphere inside of one cell: lost",
         [](double x, double y, double z) { return ball(x, y, z, .5); },
         {one_ball},
         1,
         false,
         {nothing}},
        {"stairs of whole cells",
         [](double x, double y, double z) {
             return std::floor(4 * x) + std::floor(4 * y) + std::floor(4 * z) >= 1 &&
                            box(x, y, z, .9, .9, .9) >= 0
                        ? 1.0
                        : -1.0;
         },
         {one_ball}},
    };
}

std::vector<Case> odd_values() {
    return {
        {"0 everywhere inside",
         [](double x, double y, double z) { return min(0.0, ball(x, y, z, .6)); },
         {one_ball}},
        {"0 everywhere outside: all is inside",
         [](double x, double y, double z) { return max(0.0, ball(x, y, z, .6)); },
         {one_ball},
         16,
         true},
        {"the constant 0", [](double, double, double) { return 0.0; }, {one_ball}, 6, true},
        {"the constant 1 without a cap", [](double, double, double) { return 1.0; }, {nothing}},
        {"the constant -1", [](double, double, double) { return -1.0; }, {nothing}, 16, true},
        {"undefined everywhere", [](double, double, double) { return undefined; }, {nothing}, 16, true},
        {"a square, nowhere negative",
         [](double x, double y, double z) { return ball(x, y, z, .5) * ball(x, y, z, .5); },
         {one_ball},
         16,
         true},
        {"minus a square: only the six samples on the surface are inside",
         [](double x, double y, double z) { return -ball(x, y, z, .5) * ball(x, y, z, .5); },
         {{6, 12}}},
        {"half a ball by a wall",
         [](double x, double y, double z) { return std::sqrt(x) * 0 + ball(x, y, z, .6); },
         {one_ball}},
        {"a ball by a wall",
         [](double x, double y, double z) {
             const double f = ball(x - .01, y, z, .6);
             return f >= 0 ? f : undefined;
         },
         {one_ball}},
        {"values too large",
         [](double x, double y, double z) { return 1e300 * 1e8 * ball(x, y, z, .6); },
         {one_ball}},
        {"values too small",
         [](double x, double y, double z) { return 1e-300 * ball(x, y, z, .6); },
         {one_ball}},
        {"a pole",
         [](double x, double y, double z) { return min(1 / (x - .01), box(x, y, z, .6, .6, .6)); },
         {one_ball}},
        {"a root with a vertical slope",
         [](double x, double y, double z) { return std::cbrt(ball(x, y, z, .6)); },
         {one_ball}},
        {"a root with no slope",
         [](double x, double y, double z) {
             const double b = ball(x, y, z, .6);
             return b * b * b * b * b;
         },
         {one_ball}},
        {"a jump",
         [](double x, double y, double z) { return ball(x, y, z, .6) >= 0 ? 5.0 : -1e-3; },
         {one_ball}},
    };
}

std::vector<Case> genus() {
    return {
        {"a torus",
         [](double x, double y, double z) {
             const double d = std::hypot(x, z) - 0.5;
             return 0.25 * 0.25 - d * d - y * y;
         },
         {{1, 0}}},
        {"a plate with nine holes",
         [](double x, double y, double z) {
             double f = box(x, y, z, .9, .9, .15);
             for (int i = -1; i <= 1; ++i) {
                 for (int j = -1; j <= 1; ++j) f = min(f, -(.15 - std::hypot(x - .55 * i, y - .55 * j)));
             }
             return f;
         },
         {{1, 2 - 18}},
         32},
        {"a shell",
         [](double x, double y, double z) { return min(ball(x, y, z, .9), -ball(x, y, z, .5)); },
         {two_balls}},
        {"a sphere cut by the box, capped",
         [](double x, double y, double z) { return ball(x, y, z, 1.1); },
         {one_ball},
         16,
         true},
        {"a sphere that touches the box",
         [](double x, double y, double z) { return ball(x, y, z, 1); },
         {one_ball},
         16,
         true},
        {"a saddle, capped", [](double x, double y, double z) { return x * y - z; }, {one_ball}, 16, true},
        {"a saddle through lattice points, in the middle of faces",
         [](double x, double y, double z) { return (x - h / 2) * (y - h / 2) + 1e-9 * z; },
         {one_ball, two_balls},
         16,
         true},
        {"a gyroid, capped",
         [](double x, double y, double z) {
             return std::sin(6 * x) * std::cos(6 * y) + std::sin(6 * y) * std::cos(6 * z) +
                    std::sin(6 * z) * std::cos(6 * x);
         },
         {{1, -52}},
         16,
         true},
    };
}

/// Where a lattice of samples, rather than the solid, makes it hard: the traps of dual methods.
std::vector<Case> traps() {
    const auto dot = [](double x, double y, double z, double cx, double cy, double cz) {
        return ball(x - cx, y - cy, z - cz, .06);
    };
    return {
        {"one sample inside",
         [=](double x, double y, double z) { return dot(x, y, z, 0, 0, 0); },
         {one_ball}},
        {"one sample outside: a cavity",
         [=](double x, double y, double z) { return min(box(x, y, z, .5, .5, .5), -dot(x, y, z, 0, 0, 0)); },
         {two_balls}},
        {"two samples at the ends of a face's diagonal",
         [=](double x, double y, double z) { return max(dot(x, y, z, 0, 0, 0), dot(x, y, z, h, h, 0)); },
         {two_balls}},
        {"two samples at the ends of a cell's diagonal",
         [=](double x, double y, double z) { return max(dot(x, y, z, 0, 0, 0), dot(x, y, z, h, h, h)); },
         {two_balls}},
        {"four samples of one cell, no two neighbours",
         [=](double x, double y, double z) {
             return max(max(dot(x, y, z, 0, 0, 0), dot(x, y, z, h, h, 0)),
                        max(dot(x, y, z, h, 0, h), dot(x, y, z, 0, h, h)));
         },
         {{4, 8}}},
        {"every second sample of each direction",
         [](double x, double y, double z) {
             const auto off = [](double c) { return c - 2 * h * std::floor(c / (2 * h) + .5); };
             return min(ball(off(x), off(y), off(z), .06), box(x, y, z, .55, .55, .55));
         },
         {{125, 250}}},
        {"a rod along a row of samples",
         [](double x, double y, double z) { return box(x, y, z, .7, .02, .02); },
         {one_ball}},
        {"a tunnel along a row of samples",
         [](double x, double y, double z) { return min(box(x, y, z, .5, .5, .5), std::hypot(y, z) - .03); },
         {{1, 0}}},
        {"a tunnel between rows of samples: lost",
         [](double x, double y, double z) {
             return min(box(x, y, z, .5, .5, .5), std::hypot(y - .06, z - .06) - .03);
         },
         {one_ball}},
        {"a slit on a plane of samples",
         [](double x, double y, double z) { return min(ball(x, y, z, .7), abs(x) - .02); },
         {two_balls}},
        {"two sheets in a cell: the planes of a slit, tilted",
         [](double x, double y, double z) { return min(ball(x, y, z, .7), abs(.96 * x + .28 * y) - .14); },
         {two_balls}},
        {"a roof of one degree",
         [](double x, double y, double z) {
             return min(min(.4 - .0175 * abs(x) - z, z + .3), min(.7 - abs(x), .6 - abs(y)));
         },
         {one_ball}},
        {"three cylinders cut with each other",
         [](double x, double y, double z) {
             return min(min(.6 - std::hypot(x, y), .6 - std::hypot(y, z)), .6 - std::hypot(z, x));
         },
         {one_ball}},
        {"two linked rings",
         [](double x, double y, double z) {
             const double a = std::hypot(x + .25, y) - .45, b = std::hypot(x - .25, z) - .45;
             return max(.15 * .15 - a * a - z * z, .15 * .15 - b * b - y * y);
         },
         {{2, 0}},
         24},
        {"a plate cut by its own normal turned a little",
         [](double x, double y, double z) {
             return max(box(x, y, z, .7, .1, .6), box(x, .995 * y + .0998 * x, z, .6, .1, .7));
         },
         {one_ball},
         24},
        {"a spike of a saddle: a double cone, turned",
         [](double x, double y, double z) {
             const double u = .8 * x + .6 * z, w = .8 * z - .6 * x;
             return min(w * w - u * u - y * y + 1e-4, .6 - abs(w));
         },
         {one_ball},
         40},
    };
}

void try_all(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        const std::string name = c.name;
        CAPTURE(name);
        REQUIRE_FALSE(c.right.empty());
        for (const std::pair<bool, double>& trial :
             {std::pair(false, 0.0), {false, 1e-3}, {false, 0.02}, {true, 0.0}, {true, 0.02}}) {
            const bool r_functions = trial.first;
            const double tolerance = trial.second;
            CAPTURE(r_functions);
            CAPTURE(tolerance);
            by_r_functions = r_functions;
            const FunctionField field(c.f);
            const ContourResult r = adaptive(
                field, {.bounds = Box3::cube(1), .cells = c.cells, .tolerance = tolerance, .cap = c.cap});
            const MeshReport report = sound_and_closed(r.mesh);
            const Topology found{report.components, report.euler_characteristic};
            CAPTURE(found.shells);
            CAPTURE(found.euler);
            const auto is_in = [&](const std::vector<Topology>& list) {
                return std::find(list.begin(), list.end(), found) != list.end();
            };
            const bool is_told = r.tight_cells > 0 || r.hidden_cells > 0 || r.mesh.triangles.empty();
            CHECK((is_in(c.right) || (is_told && is_in(c.if_told))));
        }
    }
    by_r_functions = false;
}

}  // namespace

TEST_CASE("solids that touch themselves") { try_all(touching()); }
TEST_CASE("thin solids") { try_all(thin()); }
TEST_CASE("surfaces on the lattice") { try_all(on_the_lattice()); }
TEST_CASE("odd values") { try_all(odd_values()); }
TEST_CASE("holes, shells, caps") { try_all(genus()); }
TEST_CASE("traps of dual methods") { try_all(traps()); }

TEST_CASE("far from the origin the mesh is still sound in binary32") {
    for (const double shift : {100.0, 3000.0}) {
        CAPTURE(shift);
        const FunctionField field([=](double x, double y, double z) {
            return max(box(x - shift, y - shift, z, .5, .4, .3), ball(x - shift, y - shift, z - .2, .45));
        });
        const Box3 bounds{{shift - 1, shift - 1, -1}, {shift + 1, shift + 1, 1}};
        const MeshReport report = sound_and_closed(adaptive(field, {.bounds = bounds, .cells = 20}).mesh);
        CHECK(report.components == 1);
        CHECK(report.euler_characteristic == 2);
    }
}

TEST_CASE("without a cap the mesh ends at the sides of the box") {
    const FunctionField field([](double x, double y, double z) { return ball(x, y, z, 1.1); });
    const ContourResult r = adaptive(field, {.bounds = Box3::cube(1), .cells = 16});
    const MeshReport report = sound(r.mesh);
    CHECK(report.boundary_edges > 0);
    CHECK(report.components == 1);
    CHECK(report.bounds->max.x == 1);
    CHECK(report.bounds->min.y == -1);
    CHECK(r.touches == std::array<bool, 6>{true, true, true, true, true, true});
}

TEST_CASE("solids about as thin as a cell are told of, and others are not") {
    const auto tilted_wall = [](double x, double y, double z) {
        return box(.96 * x + .28 * y, .96 * y - .28 * x, z, .03, .7, .6);
    };
    const auto tight_of = [](FunctionField::Value f, int cells) {
        return adaptive(FunctionField(f), {.bounds = Box3::cube(1), .cells = cells});
    };
    const ContourResult thin = tight_of(tilted_wall, 32);
    CHECK(thin.tight_cells > 4);
    REQUIRE(thin.first_tight);
    const Vec3 p = *thin.first_tight;
    CHECK(std::abs(.96 * p.x + .28 * p.y) < .03 + 2 * 2.0 / 32);
    CHECK(tight_of(tilted_wall, 64).tight_cells == 0);
    CHECK(tight_of([](double x, double y, double z) { return ball(x, y, z, .55); }, 16).tight_cells == 0);
    CHECK(
        tight_of([](double x, double y, double z) { return box(x, y, z, .47, .33, .61); }, 16).tight_cells ==
        0);
}
