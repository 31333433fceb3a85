// Strokes against the definition of their area: points within half the width of the line, for round joins and
// ends; areas worked out by hand for the others. The winding number is asked at points, so overlaps are right
// only if no part of the area cancels another.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "frep/io/stroke.h"

using namespace frep;
using namespace frep::reading;
using doctest::Approx;

namespace {

using Polygons = std::vector<std::vector<Vec2>>;

Polygons stroke(const std::vector<Vec2>& points, bool closed, const Pen& pen, double tolerance = 1e-4) {
    Polygons out;
    std::size_t count = 0;
    append_stroke({points, std::vector<bool>(points.size())}, closed, pen, tolerance, 100'000, count, out);
    std::size_t sum = 0;
    for (const auto& polygon : out) sum += polygon.size();
    CHECK(sum == count);
    return out;
}

int winding(const Polygons& polygons, Vec2 p) {
    int sum = 0;
    for (const auto& v : polygons)
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Vec2 a = v[i], b = v[(i + 1) % v.size()];
            const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
            if (a.y <= p.y && b.y > p.y && side > 0) ++sum;
            if (a.y > p.y && b.y <= p.y && side < 0) --sum;
        }
    return sum;
}

double distance(const std::vector<Vec2>& line, bool closed, Vec2 p) {
    double least = 1e300;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
        const Vec2 a = line[i], d = line[(i + 1) % line.size()] - a, q = p - a;
        const double t = std::clamp((q.x * d.x + q.y * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
        least = std::min(least, std::hypot(q.x - t * d.x, q.y - t * d.y));
    }
    return least;
}

/// Numbers in 0..1 from a counter (splitmix64).
double random_number(std::uint64_t& state) {
    std::uint64_t z = state += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

double area(const Polygons& polygons) {
    double sum = 0;
    for (const auto& v : polygons)
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Vec2 a = v[i], b = v[(i + 1) % v.size()];
            sum += 0.5 * (a.x * b.y - a.y * b.x);
        }
    return std::fabs(sum);
}

constexpr double pi = 3.14159265358979323846;

}  // namespace

TEST_CASE("a round pen covers what is within half its width of the line") {
    constexpr double tolerance = 1e-4;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        std::uint64_t state = seed;
        std::vector<Vec2> line;
        const int corners = 2 + static_cast<int>(6 * random_number(state));
        // short edges too, so that the pen is wider than they are long
        const double size = seed % 2 ? 10 : 2;
        for (int i = 0; i < corners; ++i)
            line.push_back({size * random_number(state), size * random_number(state)});
        if (seed % 5 == 0) line.push_back(line[line.size() - 2]);  // back the way it came
        const bool closed = seed % 3 == 0 && corners > 2;
        const Pen pen{1 + random_number(state), Pen::Join::round, Pen::Cap::round, 4};
        const Polygons polygons = stroke(line, closed, pen, tolerance);
        for (int i = 0; i < 2000; ++i) {
            const Vec2 p{14 * random_number(state) - 2, 14 * random_number(state) - 2};
            const double off = distance(line, closed, p) - 0.5 * pen.width;
            if (std::fabs(off) < 2 * tolerance) continue;
            CAPTURE(p.x);
            CAPTURE(p.y);
            CHECK((winding(polygons, p) != 0) == (off < 0));
        }
    }
}

TEST_CASE("joins and ends") {
    const std::vector<Vec2> corner{{0, 0}, {4, 0}, {4, 4}};
    Pen pen{2, Pen::Join::miter, Pen::Cap::butt, 4};
    // two rectangles of 4 by 2 overlap in a unit square inside the corner; the join fills the one outside
    CHECK(winding(stroke(corner, false, pen), {4.9, -0.9}) != 0);
    CHECK(winding(stroke(corner, false, pen), {-0.1, 0}) == 0);
    pen.miter_limit = 1.4;  // a right angle's miter is 1.414 widths long
    CHECK(winding(stroke(corner, false, pen), {4.9, -0.9}) == 0);
    CHECK(winding(stroke(corner, false, pen), {4.4, -0.4}) != 0);
    pen.join = Pen::Join::round;
    CHECK(winding(stroke(corner, false, pen), {4.7, -0.7}) != 0);
    CHECK(winding(stroke(corner, false, pen), {4.72, -0.72}) == 0);
    CHECK(area(stroke({{0, 0}, {4, 0}}, false, pen)) == Approx(8));
    pen.cap = Pen::Cap::square;
    CHECK(area(stroke({{0, 0}, {4, 0}}, false, pen)) == Approx(12));
    CHECK(area(stroke({{1, 1}}, false, pen)) == Approx(4));
    pen.cap = Pen::Cap::round;
    CHECK(area(stroke({{0, 0}, {4, 0}}, false, pen)) == Approx(8 + pi).epsilon(1e-3));
    CHECK(area(stroke({{1, 1}}, true, pen)) == Approx(pi).epsilon(1e-3));
    pen.cap = Pen::Cap::butt;
    CHECK(stroke({{1, 1}}, false, pen).empty());
    pen.width = 0;
    CHECK(stroke(corner, false, pen).empty());
    // a closed square has an outer and an inner boundary
    const Polygons frame = stroke({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, true, Pen{});
    REQUIRE(frame.size() == 2);
    CHECK(area(frame) == Approx(25 - 9 + 4 * 0.125));  // a part of each corner is covered twice
}
