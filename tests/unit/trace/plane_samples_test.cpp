// Tests of trace/plane_samples.h: samples lie at the middles of the pixels' parts; lines of equal value
// close, lie on the curve and enclose its area.
#include "frep/trace/plane_samples.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "plane_fields.h"

using namespace frep;
using namespace frep::drawing;
using frep::test::DiskField;
using frep::test::FunctionField;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

Lattice lattice_over(const Rectangle& part, int columns, int rows, int factor = 2) {
    const auto window = Window::around(part, columns, rows);
    REQUIRE(static_cast<bool>(window));
    return {Plane{}, *window, factor};
}

std::vector<double> values_of(const SampledField& field, const Lattice& lattice, int threads = 1) {
    FieldPool fields(field);
    Job job;
    job.threads = threads;
    const auto values = sample(fields, lattice, job);
    REQUIRE(static_cast<bool>(values));
    return *values;
}

double length_of(const std::vector<Segment>& lines) {
    double sum = 0;
    for (const Segment& s : lines) sum += std::hypot(s.a.x - s.b.x, s.a.y - s.b.y);
    return sum;
}

/// True if every end of a piece belongs to exactly two pieces.
bool all_close(const std::vector<Segment>& lines) {
    std::map<std::pair<double, double>, int> ends;
    for (const Segment& s : lines) {
        ++ends[{s.a.x, s.a.y}];
        ++ends[{s.b.x, s.b.y}];
    }
    return std::all_of(ends.begin(), ends.end(), [](const auto& e) { return e.second == 2; });
}

}  // namespace

TEST_CASE("samples lie at the middles of the parts of the pixels, rows from the top") {
    const FunctionField field([](Vec3 p) { return p.x + 100 * p.y; });
    const Lattice lattice = lattice_over({{0, 0}, {4, 2}}, 4, 2);
    const std::vector<double> v = values_of(field, lattice);
    REQUIRE(v.size() == 32);
    CHECK(v[0] == 0.25 + 175);
    CHECK(v[1] == 0.75 + 175);
    CHECK(v[8] == 0.25 + 125);
    CHECK(v[31] == 3.75 + 25);
    for (const int threads : {2, 5}) CHECK(values_of(field, lattice, threads) == v);
}

TEST_CASE("the zero line of a circle lies on it, however crooked the function is") {
    for (const double power : {1.0, 9.0}) {
        const FunctionField field([=](Vec3 p) {
            const double d = 0.7 * 0.7 - p.x * p.x - p.y * p.y;
            return power == 1 ? d : std::copysign(std::pow(std::fabs(d), power), d);
        });
        const Lattice lattice = lattice_over({{-1, -1}, {1, 1}}, 100, 100);
        const std::vector<double> v = values_of(field, lattice);
        const std::unique_ptr<SampledField> own = field.clone();
        const std::vector<Segment> line = isoline(lattice, v, 0, own.get());
        CHECK(all_close(line));
        for (const Segment& s : line) CHECK(std::fabs(std::hypot(s.a.x - 50, s.a.y - 50) - 35) < 0.01);
        CHECK(length_of(line) == doctest::Approx(2 * 3.14159265 * 35).epsilon(1e-3));
        double twice_area = 0;  // signs differ from piece to piece; the pieces do not turn around a point
        for (const Segment& s : line)
            twice_area += std::fabs((s.a.x - 50) * (s.b.y - 50) - (s.a.y - 50) * (s.b.x - 50));
        CHECK(twice_area / 2 == doctest::Approx(3.14159265 * 35 * 35).epsilon(1e-3));
    }
}

TEST_CASE("other levels are interpolated linearly") {
    const FunctionField field([](Vec3 p) { return p.x; });
    const Lattice lattice = lattice_over({{0, 0}, {10, 10}}, 10, 10);
    const std::vector<Segment> line = isoline(lattice, values_of(field, lattice), 3.3, nullptr);
    CHECK(length_of(line) == doctest::Approx(9.5));
    for (const Segment& s : line) CHECK(s.a.x == doctest::Approx(3.3));
    CHECK(isoline(lattice, values_of(field, lattice), 11, nullptr).empty());
}

TEST_CASE("a jump is found where it is") {
    const FunctionField field([](Vec3 p) { return p.x < 3.3 ? -1.0 : 5.0; });
    const Lattice lattice = lattice_over({{0, 0}, {10, 10}}, 10, 10);
    const std::unique_ptr<SampledField> own = field.clone();
    const std::vector<Segment> line = isoline(lattice, values_of(field, lattice), 0, own.get());
    REQUIRE_FALSE(line.empty());
    for (const Segment& s : line) CHECK(s.a.x == doctest::Approx(3.3).epsilon(0.001));
}

TEST_CASE("undefined and infinite values") {
    const FunctionField half([](Vec3 p) { return p.x < 0 ? undefined : p.y; });
    const Lattice lattice = lattice_over({{-5, -5}, {5, 5}}, 20, 20);
    const std::vector<Segment> line = isoline(lattice, values_of(half, lattice), 0, nullptr);
    REQUIRE_FALSE(line.empty());
    for (const Segment& s : line) CHECK(std::min(s.a.x, s.b.x) >= 10);
    CHECK(length_of(line) == doctest::Approx(9.5));
    const FunctionField steep([](Vec3 p) { return p.x < 0 ? -1 / 0.0 : 1 / 0.0; });
    for (const Segment& s : isoline(lattice, values_of(steep, lattice), 0, nullptr))
        CHECK(std::fabs(s.a.x - 10) <= 0.25);
}

TEST_CASE("a checkerboard of saddles has closed lines") {
    const FunctionField field([](Vec3 p) {
        return (static_cast<int>(std::floor(p.x * 2)) + static_cast<int>(std::floor(p.y * 2))) % 2 ? 1.0
                                                                                                   : -1.2;
    });
    const Lattice lattice = lattice_over({{0, 0}, {10, 10}}, 10, 10);
    const std::vector<Segment> line = isoline(lattice, values_of(field, lattice), 0, nullptr);
    CHECK(line.size() == 2 * 19 * 19);
}

TEST_CASE("a cancelled job is an error") {
    const DiskField field({0, 0}, 1);
    FieldPool fields(field);
    Job job;
    job.cancel();
    const auto values = sample(fields, lattice_over({{-1, -1}, {1, 1}}, 10, 10), job);
    REQUIRE_FALSE(static_cast<bool>(values));
    CHECK(values.error().kind == ErrorKind::cancelled);
}
