// Bounds of a function in cells: they hold at every point, and come nearer with the square of the cell.
#include "frep/measure/cell_bounds.h"

#include <cmath>
#include <random>
#include <string>

#include "unit/measure/models.h"

using namespace frep;
using namespace frep::test;
using namespace frep::measuring;

namespace {

CellBounds bounds_in(CellJudge& judge, const Cell& cell) {
    CellBounds out;
    const CellSource source;
    judge.judge({&cell, 1}, {&source, 1}, {&out, 1});
    return out;
}

/// The function on the lattice at u in 0..1: linear in the Kuhn simplex of u in its part of the cell.
double between(const std::array<double, 27>& points, std::array<double, 3> u) {
    constexpr std::array<std::size_t, 3> step{1, 3, 9};
    std::array<std::size_t, 3> order{0, 1, 2};
    std::size_t point = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] *= 2;
        if (u[k] < 1) continue;
        u[k] -= 1;
        point += step[k];
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return u[a] > u[b]; });
    double value = points[point];
    for (const std::size_t axis : order) {
        const std::size_t next = point + step[axis];
        value += u[axis] * (points[next] - points[point]);
        point = next;
    }
    return value;
}

}  // namespace

TEST_CASE("linear bounds hold at every point") {
    for (const char* body :
         {"my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;", "my_model = sin(3*x[1])*x[2] + x[3]*x[1];",
          "my_model = (1 - x[1]^2 - x[2]^2) & (0.5 - x[3]*x[1]);",
          "my_model = max(min(x[1], x[2]), 0.3 - abs(x[3]));"}) {
        CAPTURE(body);
        const std::string text = body;
        const bool is_same = text.find('&') == text.npos && text.find("min") == text.npos;
        const Field field = space_field_of(text);
        auto judge = CellJudge::make(field, {0, 1, 2}, {});
        REQUIRE(judge);
        const auto evaluator = make_evaluator(field);
        REQUIRE(evaluator);
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> number(0, 1);
        int planes = 0;
        for (int n = 0; n < 300; ++n) {
            Cell cell;
            const double side = n % 2 == 0 ? 0.5 : 0.03;
            for (std::size_t k = 0; k < 3; ++k) {
                cell.low[k] = 2 * number(random) - 1;
                cell.high[k] = cell.low[k] + side * (0.2 + number(random));
            }
            const CellBounds bounds = bounds_in(*judge, cell);
            planes += bounds.has_planes ? 1 : 0;
            for (int m = 0; m < 20; ++m) {
                std::array<double, 3> u{number(random), number(random), number(random)};
                std::array<double, 3> p{};
                for (std::size_t k = 0; k < 3; ++k) p[k] = cell.low[k] + u[k] * (cell.high[k] - cell.low[k]);
                const double* point[] = {&p[0], &p[1], &p[2]};
                double f = 0;
                double* out[] = {&f};
                (*evaluator)->values(point, 1, out);
                CAPTURE(n);
                if (bounds.sign == CellSign::inside) CHECK(f >= 0);
                if (bounds.sign == CellSign::outside) CHECK(f < 0);
                if (!bounds.has_planes) continue;
                if (between(bounds.lower, u) > 1e-12) CHECK(f >= 0);
                if (between(bounds.upper, u) < -1e-12) CHECK(f < 0);
                if (!is_same) continue;  // a set operation may stand for one with the same sign
                CHECK(between(bounds.lower, u) <= f + 1e-12);
                CHECK(between(bounds.upper, u) >= f - 1e-12);
            }
        }
        CHECK(planes > 20);
    }
}

TEST_CASE("the gap between the bounds shrinks with the square of the cell") {
    auto judge = CellJudge::make(space_field_of("my_model = 1 - x[1]^2 - x[2]^2 - x[3]^2;"), {0, 1, 2}, {});
    REQUIRE(judge);
    const auto gap = [&](double half) {
        const CellBounds b =
            bounds_in(*judge, {{0.6 - half, -half, 0.8 - half}, {0.6 + half, half, 0.8 + half}});
        REQUIRE(b.has_planes);
        return b.upper[0] - b.lower[0];
    };
    // second derivatives of 2 in each of three axes, over lines of length half
    CHECK(gap(0.1) == doctest::Approx(3 * 2 * 0.01 / 8));
    CHECK(gap(0.01) == doctest::Approx(3 * 2 * 0.0001 / 8));
}

TEST_CASE("without derivatives signs are found, and no planes") {
    auto judge =
        CellJudge::make(space_field_of("my_model = hfA_Turbulence(x, 1) + 30 - x[1]^2;"), {0, 1, 2}, {});
    REQUIRE(judge);
    CHECK(bounds_in(*judge, {{0, 0, 0}, {0.1, 0.1, 0.1}}).sign == CellSign::inside);
    const CellBounds open = bounds_in(*judge, {{0, 0, 0}, {90, 1, 1}});
    CHECK(open.sign == CellSign::open);
    CHECK_FALSE(open.has_planes);
}

TEST_CASE("a cell where the function may be undefined or jump has no planes") {
    auto judge = CellJudge::make(space_field_of("my_model = sqrt(x[1]) + x[2];"), {0, 1, 2}, {});
    REQUIRE(judge);
    const CellBounds root = bounds_in(*judge, {{-1, -1, -1}, {1, 1, 1}});
    CHECK(root.sign == CellSign::open);
    CHECK(root.maybe_undefined);
    CHECK_FALSE(root.has_planes);
    CHECK(bounds_in(*judge, {{-2, 0, 0}, {-1, 1, 1}}).sign == CellSign::outside);
    auto steps = CellJudge::make(
        space_field_of("f = x[2] - 3; if (x[1] < 0.5) then f = x[2]; endif; my_model = f;"), {0, 1, 2}, {});
    REQUIRE(steps);
    CHECK_FALSE(bounds_in(*steps, {{0, -1, -1}, {1, 1, 1}}).has_planes);
}
