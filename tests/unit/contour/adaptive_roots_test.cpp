// Tests of contour/edge_roots.h: the crossing is bracketed to root_width, in few steps where F is smooth and
// never in more than bisection, six, and the signs of three rounds. Among several crossings signs choose.
#include "frep/contour/edge_roots.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/contour/test_fields.h"

using namespace frep;
using namespace frep::contouring;
using test::FunctionField;
using test::infinity;
using test::undefined;

namespace {

struct Search {
    EdgeRoot root;
    int evaluations = 0;
};

/// Along x from 2 to 6; with the samples at -2 and 10 if there is a model.
Search search(const std::function<double(double)>& f, bool model = false, double before = undefined) {
    Search result;
    FunctionField field([&](double x, double, double) {
        ++result.evaluations;
        return f(x);
    });
    CrossedEdge edge;
    edge.lower = {2, -1, 7};
    edge.length = 4;
    edge.axis = 0;
    edge.lower_value = f(2);
    edge.upper_value = f(6);
    if (model) predict(edge, before == before ? before : f(-2), f(10));
    std::vector<EdgeRoot> roots;
    EdgeRoots().find(field, {edge}, roots);
    REQUIRE(roots.size() == 1);
    result.root = roots[0];
    CHECK(f(2 + 4 * roots[0].inside) >= 0);
    CHECK(!(f(2 + 4 * roots[0].outside) >= 0));
    CHECK(std::abs(roots[0].inside - roots[0].outside) <= root_width);
    CHECK(result.evaluations <= 46 + 3 * 8);
    return result;
}

}  // namespace

TEST_CASE("smooth functions take few steps") {
    CHECK(search([](double x) { return x - 3.7; }).evaluations <= 6);
    CHECK(search([](double x) { return 3.7 - x; }).evaluations <= 6);
    CHECK(search([](double x) { return 25 - x * x; }).evaluations <= 25);
    CHECK(search([](double x) { return x * x - 7; }).evaluations <= 20);
    CHECK(search([](double x) { return 1e200 * (x - 5.9999); }).evaluations <= 8);
    CHECK(search([](double x) { return 1e-250 * (2.5 - x); }).evaluations <= 8);
    CHECK(std::abs(search([](double x) { return x - 3.7; }).root.inside - 0.425) <= root_width);
}

TEST_CASE("crossings at the very ends") {
    CHECK(search([](double x) { return 2 - x; }).root.inside == 0);
    CHECK(search([](double x) { return x - 6; }).root.inside == 1);
    CHECK(search([](double x) { return 2 - x; }).evaluations <= 6);
}

TEST_CASE("hard functions take no more than bisection, six, and three rounds of signs") {
    search([](double x) { return x < 3.1 ? 1.0 : -1e-9; });
    search([](double x) { return std::pow(x - 4.3, 9); });
    search([](double x) { return std::cbrt(x - 4.3); });
    search([](double x) { return x < 4.5 ? infinity : -infinity; });
    search([](double x) { return x < 4.5 ? 0.0 : -1.0; });
    search([](double x) { return 1 / (x - 3.3); });
    search([](double x) { return std::sin(40 * x) + (3.5 - x); });
}

TEST_CASE("with a model of a smooth function three steps are enough") {
    const auto wave = [](double x) { return std::sin(0.02 * x + 0.1) - 0.19; };
    CHECK(search(wave, true).evaluations <= 3);
    CHECK(search(wave, true, infinity).evaluations <= 5);
    CHECK(search([](double x) { return 25 - x * x; }, true).evaluations <= 5);
    CHECK(search([](double x) { return x + 0.001 * x * x * x - 3.9; }, true).evaluations <= 3);
    CHECK(search([](double x) { return x - 2.0000001; }, true).evaluations <= 3);
    CHECK(search(wave).evaluations > 3);
}

TEST_CASE("a model that misleads costs little, and one of infinite samples is none") {
    const auto bent = [](double x) { return x < 4.1 ? 4 - x : 100 * (4.099 - x); };
    CHECK(search(bent, true).evaluations <= 36);
    search([](double x) { return std::cbrt(x - 4.3); }, true);
    search([](double x) { return 3 - x; }, true, 1e300);
    search([](double x) { return 3 - x; }, true, -1e300);
    search([](double x) { return x < 3.1 ? 1.0 : -1e-9; }, true);
    CrossedEdge edge;
    edge.lower_value = 1;
    edge.upper_value = -3;
    predict(edge, infinity, undefined);
    CHECK(!edge.model.is_known());
    predict(edge, infinity, -7);
    CHECK(edge.model.is_known());
    CHECK(edge.model.root == doctest::Approx(0.25));
    edge.upper_value = -infinity;
    predict(edge, 5, -7);
    CHECK(!edge.model.is_known());
}

TEST_CASE("among several crossings signs choose, not values") {
    // Positive factors, and a mixture of sums and roots as R-functions have it, keep the signs.
    const std::function<double(double)> scales[] = {
        [](double) { return 1.0; },
        [](double x) { return std::exp(3 * x); },
        [](double x) { return std::exp(-3 * x); },
        [](double x) { return 1e-3 + (x - 3) * (x - 3); },
        [](double x) { return 1 / (1e-3 + (x - 5) * (x - 5)); },
        [](double x) { return 2 + std::sin(9 * x); },
    };
    for (int place = 0; place < 60; ++place) {
        CAPTURE(place);
        // inside up to `first`, and again between the other two
        const double first = 2.1 + 0.02 * place, second = first + 0.9, third = second + 0.4 + 0.02 * place;
        for (const bool model : {false, true}) {
            double found = 0;
            for (const auto& scale : scales) {
                const auto f = [&](double x) { return scale(x) * (first - x) * (second - x) * (third - x); };
                const double t = search(f, model).root.inside;
                if (&scale == scales) found = t;
                CHECK(std::abs(t - found) <= 2 * root_width);
            }
        }
    }
}

TEST_CASE("a wall, where F ends") {
    CHECK(search([](double x) { return x < 5 ? 1.0 : undefined; }).root.is_wall);
    CHECK(search([](double x) { return x < 5 ? undefined : 1.0; }).root.is_wall);
    CHECK(!search([](double x) { return 5 - x; }).root.is_wall);
    CHECK(!search([](double x) { return x < 3 ? 3 - x : x < 4 ? -1.0 : undefined; }).root.is_wall);
}

TEST_CASE("an edge's result does not depend on the others") {
    const FunctionField f(
        [](double x, double y, double z) { return std::sin(3 * x + y) + 0.3 * z - 0.1 * x * y; });
    FunctionField field = f;
    std::vector<CrossedEdge> edges;
    for (std::uint64_t i = 0; edges.size() < 100; ++i) {
        CrossedEdge e;
        e.lower = {test::noise(1, i), test::noise(2, i), test::noise(3, i)};
        e.length = 0.5;
        e.axis = static_cast<std::uint8_t>(i % 3);
        const Vec3 q = point_on(e, 1);
        e.lower_value = f(e.lower.x, e.lower.y, e.lower.z);
        e.upper_value = f(q.x, q.y, q.z);
        if ((e.lower_value >= 0) != (e.upper_value >= 0)) edges.push_back(e);
    }
    std::vector<EdgeRoot> all, one;
    EdgeRoots finder;
    finder.find(field, edges, all);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        finder.find(field, {edges[i]}, one);
        CHECK(one[0].inside == all[i].inside);
        CHECK(one[0].outside == all[i].outside);
    }
}
