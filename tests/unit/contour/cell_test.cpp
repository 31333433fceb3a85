// Tests of contour/cell.h: the graph of a cell for every sign pattern, the saddle rule, the cutting of
// polygons.
#include "frep/contour/cell.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "unit/contour/test_fields.h"

using namespace frep;
using namespace frep::contouring;

namespace {

std::vector<std::vector<std::uint8_t>> polygons_of(const std::array<double, 8>& values) {
    const CellPolygons cell = trace_cell(values);
    std::vector<std::vector<std::uint8_t>> polygons;
    std::size_t at = 0;
    for (std::size_t p = 0; p < cell.count; ++p) {
        polygons.emplace_back(cell.edges.begin() + at, cell.edges.begin() + at + cell.lengths[p]);
        at += cell.lengths[p];
    }
    return polygons;
}

/// Values of random size with the given signs.
std::array<double, 8> random_values(unsigned inside, std::uint64_t seed) {
    std::array<double, 8> values{};
    for (unsigned c = 0; c < 8; ++c) {
        const double size = 0.01 + std::abs(test::noise(seed, 8 * inside + c));
        values[c] = (inside >> c & 1u) != 0 ? size : -size;
    }
    return values;
}

using Step = std::pair<int, int>;

/// The directed branches of all polygons; a branch used twice is a failure.
std::set<Step> branches_of(const std::vector<std::vector<std::uint8_t>>& polygons) {
    std::set<Step> branches;
    for (const auto& p : polygons) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            REQUIRE(branches.insert({p[i], p[(i + 1) % p.size()]}).second);
        }
    }
    return branches;
}

Vec3 node_of(std::uint8_t edge, const std::array<double, 8>& values) {
    const auto& a = corner_offsets[edge_corners[edge][0]];
    const auto& b = corner_offsets[edge_corners[edge][1]];
    const double va = values[edge_corners[edge][0]], vb = values[edge_corners[edge][1]];
    const double t = va / (va - vb);
    const Vec3 p{double(a[0]), double(a[1]), double(a[2])}, q{double(b[0]), double(b[1]), double(b[2])};
    return p + t * (q - p);
}

}  // namespace

TEST_CASE("every sign pattern with random values gives disjoint polygons over all active edges") {
    std::set<std::size_t> lengths;
    std::size_t most = 0;
    for (unsigned inside = 0; inside < 256; ++inside) {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            const std::array<double, 8> values = random_values(inside, seed);
            const auto polygons = polygons_of(values);
            std::set<std::uint8_t> nodes;
            for (const auto& p : polygons) {
                lengths.insert(p.size());
                for (const std::uint8_t e : p) REQUIRE(nodes.insert(e).second);  // degree 2: once each
                for (std::size_t i = 0; i < p.size(); ++i) {
                    REQUIRE(share_face(p[i], p[(i + 1) % p.size()]));  // every branch lies on a face
                }
            }
            for (std::uint8_t e = 0; e < 12; ++e) {
                const bool active = (values[edge_corners[e][0]] >= 0) != (values[edge_corners[e][1]] >= 0);
                REQUIRE(active == (nodes.count(e) == 1));
            }
            most = std::max(most, polygons.size());
        }
    }
    CHECK(lengths == std::set<std::size_t>{3, 4, 5, 6, 7, 8, 9, 12});
    CHECK(most == 4);
}

TEST_CASE("neighbouring cells run through the branches of their common face in opposite directions") {
    // Cell B is cell A mirrored to the other side of A's face x = 1: it sees the same four values there.
    constexpr std::array<int, 4> right{1, 2, 6, 5}, left{0, 3, 7, 4};
    constexpr std::array<int, 4> right_edges{1, 10, 5, 9}, left_edges{3, 11, 7, 8};
    std::size_t compared = 0;
    for (unsigned inside = 0; inside < 256; ++inside) {
        for (std::uint64_t seed = 0; seed < 16; ++seed) {
            const std::array<double, 8> a = random_values(inside, seed);
            std::array<double, 8> b = random_values((inside * 77 + 13) & 255u, seed + 99);
            for (std::size_t i = 0; i < 4; ++i) b[left[i]] = a[right[i]];
            const std::set<Step> branches_a = branches_of(polygons_of(a));
            const std::set<Step> branches_b = branches_of(polygons_of(b));
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < 4; ++j) {
                    const bool in_a = branches_a.count({right_edges[i], right_edges[j]}) == 1;
                    const bool in_b = branches_b.count({left_edges[j], left_edges[i]}) == 1;
                    REQUIRE(in_a == in_b);
                    compared += in_a ? 1 : 0;
                }
            }
        }
    }
    CHECK(compared > 1000);
}

TEST_CASE("single inside corners give outward triangles, opposite ones two") {
    for (unsigned c = 0; c < 8; ++c) {
        std::array<double, 8> values;
        values.fill(-1);
        values[c] = 1;
        const auto polygons = polygons_of(values);
        REQUIRE(polygons.size() == 1);
        REQUIRE(polygons[0].size() == 3);
        const Vec3 a = node_of(polygons[0][0], values), b = node_of(polygons[0][1], values);
        const Vec3 d = node_of(polygons[0][2], values);
        const auto& o = corner_offsets[c];
        CHECK(dot(cross(b - a, d - a), a - Vec3{double(o[0]), double(o[1]), double(o[2])}) > 0);
    }
    std::array<double, 8> values;
    values.fill(-1);
    values[0] = values[6] = 1;
    const auto two = polygons_of(values);
    REQUIRE(two.size() == 2);
    CHECK(two[0].size() == 3);
    CHECK(two[1].size() == 3);
}

TEST_CASE("the saddle decides an ambiguous face") {
    // Lower face 1, -2, 1, -2 (apart) or 2, -1, 2, -1 (joined); the upper one is outside.
    CHECK(polygons_of({1, -2, 1, -2, -3, -3, -3, -3}).size() == 2);
    const auto one = polygons_of({2, -1, 2, -1, -3, -3, -3, -3});
    REQUIRE(one.size() == 1);
    CHECK(one[0].size() == 6);
    CHECK(polygons_of({1, -1, 1, -1, -3, -3, -3, -3}).size() == 1);  // a tie joins the inside
}

TEST_CASE("the saddle rule agrees with the position of the hyperbola's centre") {
    std::size_t joined = 0;
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const double f00 = std::abs(test::noise(1, i)), f11 = std::abs(test::noise(2, i));
        const double f10 = -std::abs(test::noise(3, i)) - 1e-9, f01 = -std::abs(test::noise(4, i)) - 1e-9;
        const double node = f00 / (f00 - f10);                        // on the side v = 0
        const double centre = (f00 - f01) / (f00 + f11 - f10 - f01);  // u of the centre
        if (std::abs(node - centre) < 1e-12) continue;
        const bool joins = face_joins_inside(f00, f11, f10, f01);
        // A node beyond the centre belongs to the arc on the right: around the outside corner (1, 0).
        REQUIRE(joins == (node > centre));
        REQUIRE(joins == face_joins_inside(f11, f00, f01, f10));
        joined += joins ? 1 : 0;
    }
    CHECK(joined > 30000);
    CHECK(joined < 70000);
}

TEST_CASE("the saddle rule at the ends of the number range") {
    using test::infinity;
    using test::undefined;
    CHECK(face_joins_inside(2e-300, 2e-300, -1e-300, -1e-300));
    CHECK_FALSE(face_joins_inside(1e-300, 1e-300, -2e-300, -2e-300));
    CHECK(face_joins_inside(2e300, 2e300, -1e300, -1e300));
    CHECK_FALSE(face_joins_inside(1e300, 1e300, -2e300, -2e300));
    CHECK(face_joins_inside(infinity, 1, -1, -1));
    CHECK_FALSE(face_joins_inside(1, 1, -infinity, -1));
    CHECK(face_joins_inside(infinity, infinity, -infinity, -infinity));
    CHECK_FALSE(face_joins_inside(0, infinity, -1, -1));  // a corner on the surface
    CHECK_FALSE(face_joins_inside(1, 1, undefined, -1));
    CHECK_FALSE(face_joins_inside(1, 1, -1, undefined));
    CHECK_FALSE(face_joins_inside(0, 0, -1, -1));
}

TEST_CASE("cutting: all nodes used, consistent direction, no diagonal on a face") {
    std::map<std::size_t, std::size_t> with_middle, seen;
    for (unsigned inside = 0; inside < 256; ++inside) {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            for (const auto& p : polygons_of(random_values(inside, seed))) {
                std::vector<std::array<std::uint8_t, 3>> cut;
                const bool middle = triangulate(p, cut);
                const std::size_t n = p.size();
                ++seen[n];
                with_middle[n] += middle ? 1 : 0;
                REQUIRE(cut.size() == (middle ? n : n - 2));
                std::map<Step, int> uses;
                for (const auto& t : cut) {
                    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
                }
                for (const auto& [step, count] : uses) {
                    REQUIRE(count == 1);
                    const auto [from, to] = step;
                    const bool is_side = std::size_t(to) == (std::size_t(from) + 1) % n && from < int(n);
                    if (is_side) continue;
                    REQUIRE(uses.count({to, from}) == 1);  // diagonals are used once in each direction
                    if (from < int(n) && to < int(n)) REQUIRE_FALSE(share_face(p[from], p[to]));
                }
                for (std::size_t i = 0; i < n; ++i) REQUIRE(uses.count({int(i), int((i + 1) % n)}) == 1);
            }
        }
    }
    for (const std::size_t n : {3, 4, 5, 6, 7}) CHECK(with_middle[n] == 0);
    for (const std::size_t n : {9, 12}) CHECK(with_middle[n] == seen[n]);
    CHECK(seen[12] > 0);
}
