// Tests of geom/triangle_overlap.h: each way in which two triangles can lie, and random ones on a small grid
// against the oracle of exact_reference.h.
#include "frep/geom/triangle_overlap.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "unit/geom/exact_reference.h"

using namespace frep;
using test::Random;

namespace {

bool same(const Vec3& a, const Vec3& b) { return a == b; }

/// Puts the common corners first; the number of them.
int align(Corners& a, Corners& b) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = shared; j < 3; ++j) {
            if (!same(a[i], b[j])) continue;
            std::swap(a[i], a[shared]);
            std::swap(b[j], b[shared]);
            ++shared;
            break;
        }
    }
    return static_cast<int>(shared);
}

std::optional<Vec3> meeting(Corners a, Corners b) {
    const int shared = align(a, b);
    return common_point(a, b, shared);
}

bool meet(const Corners& a, const Corners& b) {
    const bool answer = meeting(a, b).has_value();
    CHECK(meeting(b, a).has_value() == answer);
    CHECK(meeting({a[1], a[2], a[0]}, b).has_value() == answer);
    CHECK(meeting(a, {b[1], b[0], b[2]}).has_value() == answer);
    return answer;
}

/// The triangle that the cases are put against: in the plane z = 0.
const Corners base{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};

}  // namespace

TEST_CASE("triangles without a common corner") {
    CHECK(meet(base, {Vec3{1, 1, -1}, Vec3{1, 1, 1}, Vec3{9, 9, 1}}));        // an edge pierces
    CHECK(meet(base, {Vec3{-1, 1, -1}, Vec3{-1, 1, 1}, Vec3{1, 1, 0.25}}));   // its edge is pierced
    CHECK_FALSE(meet(base, {Vec3{1, 1, 1}, Vec3{2, 1, 1}, Vec3{1, 2, 1}}));   // parallel above
    CHECK_FALSE(meet(base, {Vec3{5, 5, -1}, Vec3{5, 5, 1}, Vec3{9, 9, 1}}));  // crosses the plane beside
    CHECK_FALSE(meet(base, {Vec3{3, 3, -1}, Vec3{3, 3, 1}, Vec3{9, 9, 1}}));  // within the box, beside
    CHECK(meet(base, {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{2, 2, 1}}));         // a corner inside
    CHECK(meet(base, {Vec3{2, 0, 0}, Vec3{2, 0, 1}, Vec3{2, -2, 1}}));        // a corner on an edge
    CHECK(meet(base, {Vec3{2, 2, -1}, Vec3{2, 2, 1}, Vec3{9, 9, 1}}));        // edge against edge, a point
    CHECK(meet(base, {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{-1, -1, 0}}));      // a corner on its edge
    CHECK(meet(base, {Vec3{1, 0, 0}, Vec3{3, 0, 0}, Vec3{2, -1, 5}}));        // edges along each other
}

TEST_CASE("triangles in one plane without a common corner") {
    CHECK(meet(base, {Vec3{1, 1, 0}, Vec3{9, 1, 0}, Vec3{1, 9, 0}}));        // overlap
    CHECK(meet(base, {Vec3{1, 1, 0}, Vec3{1.5, 1, 0}, Vec3{1, 1.5, 0}}));    // one inside the other
    CHECK(meet(base, {Vec3{2, 2, 0}, Vec3{9, 2, 0}, Vec3{2, 9, 0}}));        // a corner on an edge
    CHECK(meet(base, {Vec3{1, 0, 0}, Vec3{3, 0, 0}, Vec3{2, -1, 0}}));       // along an edge
    CHECK(meet(base, {Vec3{-1, 3, 0}, Vec3{3, -1, 0}, Vec3{-9, -9, 0}}));    // edges cross, no corner inside
    CHECK_FALSE(meet(base, {Vec3{3, 3, 0}, Vec3{9, 3, 0}, Vec3{3, 9, 0}}));  // beside
    CHECK_FALSE(meet(base, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}));  // beside, in line
}

TEST_CASE("triangles with one common corner") {
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{1, 1, 1}, Vec3{1, 2, 1}}));       // above
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{-1, -1, -1}, Vec3{-1, -1, 1}}));  // through the plane, behind
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{1, 1, -1}, Vec3{1, 1, 1}}));            // pierces
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{9, 9, -1}, Vec3{9, 9, 1}}));  // is pierced by its far edge
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}}));   // an edge lies in it
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, -1, 1}}));  // edges along each other
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{2, 1, 0}, Vec3{1, 2, 0}}));   // in the plane, inside
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{9, -1, 0}, Vec3{9, 1, 0}}));  // in the plane, across an edge
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{-2, 1, 0}, Vec3{-2, -2, 0}}));  // in the plane, beside
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}));   // edges prolonged
}

TEST_CASE("triangles with a common edge") {
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 1, 1}}));   // a fold
    CHECK_FALSE(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, -1, 0}}));  // flat, side by side
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 1, 0}}));         // folded over, inside
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{9, 9, 0}}));         // folded over, reaching out
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{4, 4, 0}}));         // folded over, edges cross
    CHECK(meet(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{-5, 1, 0}}));        // folded over, sideways
}

TEST_CASE("equal triangles overlap") {
    CHECK(meet(base, base));
    CHECK(meet(base, {base[0], base[2], base[1]}));  // the opposite orientation
}

TEST_CASE("triangles without area are segments") {
    const Corners line{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{4, 0, 0}};  // an edge of base with a point on it
    CHECK_FALSE(meet(base, line));                                    // shares the edge: not more
    CHECK_FALSE(meet(line, {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, -1, 0}}));
    CHECK_FALSE(meet(line, {Vec3{2, 0, 0}, Vec3{1, 1, 1}, Vec3{3, 1, 1}}));  // its middle corner
    CHECK(meet(line, {Vec3{2, 0, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}}));       // runs into the triangle
    CHECK(meet(line, {Vec3{1, 0, 0}, Vec3{1, 1, 1}, Vec3{3, 1, 1}}));        // a corner on it
    CHECK(meet(base, {Vec3{1, 1, -1}, Vec3{1, 1, 0}, Vec3{1, 1, 3}}));       // pierces
    CHECK_FALSE(meet(base, {Vec3{1, 1, 1}, Vec3{1, 1, 2}, Vec3{1, 1, 3}}));
    CHECK(meet(line, {Vec3{3, -1, 0}, Vec3{3, 0, 0}, Vec3{3, 1, 0}}));        // two segments cross
    CHECK_FALSE(meet(line, {Vec3{3, -1, 1}, Vec3{3, 0, 1}, Vec3{3, 1, 1}}));  // askew
    CHECK(meet(line, {Vec3{1, 0, 0}, Vec3{3, 0, 0}, Vec3{9, 0, 0}}));         // on one line
    CHECK_FALSE(meet(line, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{9, 0, 0}}));   // on one line, apart
    CHECK_FALSE(meet(line, {Vec3{4, 0, 0}, Vec3{6, 0, 0}, Vec3{9, 0, 0}}));   // end to end
    CHECK(meet(line, {Vec3{4, 0, 0}, Vec3{3, 0, 0}, Vec3{9, 0, 0}}));         // a common corner, overlap
    CHECK_FALSE(meet(line, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 0, 0}}));   // the same segment
    CHECK(meet(line, {Vec3{2, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 0, 0}}));         // both reach beyond the edge
    CHECK_FALSE(meet(line, {Vec3{2, 0, 0}, Vec3{4, 0, 0}, Vec3{5, 0, 0}}));   // to different sides
    CHECK_FALSE(meet(line, line));
}

TEST_CASE("the place lies in both triangles") {
    const Vec3 at = meeting(base, {Vec3{1, 1, -1}, Vec3{1, 1, 3}, Vec3{2, 1, 2}}).value();
    CHECK(at == Vec3{1, 1, 0});
    CHECK(meeting(base, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{4, 4, 0}}).value() == Vec3{2, 2, 0});
    CHECK(meeting(base, {Vec3{0, 0, 0}, Vec3{8, 8, -1}, Vec3{8, 8, 1}}).value() == Vec3{2, 2, 0});
}

TEST_CASE("random triangles on a grid, against exact clipping") {
    Random random(7);
    int counts[4][2] = {};
    for (int i = 0; i < 30000; ++i) {
        const int n = 2 + random.below(4), depth = 1 + random.below(n);
        const auto point = [&] {
            return Vec3{static_cast<double>(random.below(n)), static_cast<double>(random.below(n)),
                        static_cast<double>(random.below(depth))};
        };
        Corners a{point(), point(), point()}, b{point(), point(), point()};
        for (std::size_t k = 0; k < 3; ++k) {
            if (random.below(4) == 0) b[k] = a[k];
        }
        if (same(a[0], a[1]) || same(a[1], a[2]) || same(a[2], a[0])) continue;
        if (same(b[0], b[1]) || same(b[1], b[2]) || same(b[2], b[0])) continue;
        const auto integer = [](const Corners& t) {
            return test::IntegerTriangle{test::integer_point(t[0]), test::integer_point(t[1]),
                                         test::integer_point(t[2])};
        };
        const bool expected = test::meet_outside_shared(integer(a), integer(b));
        const int shared = align(a, b);
        CAPTURE(i);
        CAPTURE(shared);
        CHECK(common_point(a, b, shared).has_value() == expected);
        CHECK(common_point(b, a, shared).has_value() == expected);
        ++counts[shared][expected ? 1 : 0];
    }
    for (int shared = 0; shared < 4; ++shared) {
        CAPTURE(shared);
        CHECK(counts[shared][0] > 5);
        CHECK(counts[shared][1] > 100);
    }
}
