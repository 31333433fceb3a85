// Tests of io/read_polygon.h: areas of the triangles of convex, concave and hostile polygons.
#include "frep/io/read_polygon.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "frep/math/vec.h"

using namespace frep;
using reading::Triangulator;

namespace {

struct Covered {
    std::size_t triangles;
    double signed_area;    // about the polygon's own normal
    double absolute_area;  // equal to it when no triangle is turned over
};

Covered covered(const std::vector<Vec3>& vertices, const Vec3& unit_normal) {
    std::vector<std::uint32_t> corners(vertices.size());
    std::iota(corners.begin(), corners.end(), 0u);
    std::vector<Triangle> triangles;
    Triangulator().add(vertices, corners, triangles);
    Covered out{triangles.size(), 0, 0};
    for (const Triangle& t : triangles) {
        const double area =
            0.5 * dot(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]), unit_normal);
        out.signed_area += area;
        out.absolute_area += std::fabs(area);
    }
    return out;
}

}  // namespace

TEST_CASE("convex polygons are fans from the first corner") {
    const std::vector<Vec3> hexagon{{2, 0, 5}, {1, 2, 5}, {-1, 2, 5}, {-2, 0, 5}, {-1, -2, 5}, {1, -2, 5}};
    std::vector<Triangle> triangles;
    Triangulator().add(hexagon, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}, triangles);
    CHECK(triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
}

TEST_CASE("concave polygons are covered exactly, in every plane and direction") {
    // an arrow head whose fan from corner 0 would leave it: area 6
    const std::vector<std::pair<double, double>> arrow{{0, 0}, {3, 3}, {0, 2}, {-3, 3}};
    // a letter E, 5 high and 3 wide: area 5 + 2 * 3 = 11
    const std::vector<std::pair<double, double>> letter{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2},
                                                        {3, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}};
    for (const bool reversed : {false, true}) {
        for (int plane = 0; plane < 3; ++plane) {
            for (const auto* outline : {&arrow, &letter}) {
                std::vector<Vec3> vertices;
                for (const auto& point : *outline) {
                    const double u = point.first, v = point.second;
                    vertices.push_back(plane == 0 ? Vec3{7, u, v}
                                                  : (plane == 1 ? Vec3{v, 7, u} : Vec3{u, v, 7}));
                }
                if (reversed) vertices = std::vector<Vec3>(vertices.rbegin(), vertices.rend());
                Vec3 normal = plane == 0 ? Vec3{1, 0, 0} : (plane == 1 ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
                if (reversed) normal = -1.0 * normal;
                const Covered result = covered(vertices, normal);
                const double area = outline == &arrow ? 6.0 : 11.0;
                CHECK(result.triangles == outline->size() - 2);
                CHECK(result.signed_area == doctest::Approx(area));
                CHECK(result.absolute_area == doctest::Approx(area));
            }
        }
    }
}

TEST_CASE("a star of 999 corners is covered exactly; beyond 1000 corners a fan") {
    for (const int n : {998, 1200}) {
        std::vector<Vec3> star;
        double area = 0;
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * 3.14159265358979 * i / n, r = i % 2 == 0 ? 2 : 1;
            star.push_back({r * std::cos(angle), r * std::sin(angle), 0});
        }
        for (int i = 0; i < n; ++i)
            area +=
                0.5 * cross(star[static_cast<std::size_t>(i)], star[static_cast<std::size_t>((i + 1) % n)]).z;
        const Covered result = covered(star, {0, 0, 1});
        CHECK(result.triangles == static_cast<std::size_t>(n - 2));
        CHECK(result.signed_area == doctest::Approx(area));
        CHECK((result.absolute_area < area * 1.000001) == (n <= 1000));
    }
}

TEST_CASE("hostile polygons end, with at most two triangles fewer than corners") {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1e308, -1e308, 1e308},
                                   {0, 0, 0}};
    std::uint32_t state = 1;
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::uint32_t> corners;
        for (int i = 0; i < round % 12; ++i) {
            state = state * 1664525u + 1013904223u;
            corners.push_back((state >> 16) % 6);
        }
        Triangulator triangulator;
        std::vector<Triangle> triangles;
        triangulator.add(points, corners, triangles);
        if (corners.size() < 3) {
            CHECK(triangulator.dropped_faces() == 1);
        } else {
            CHECK(triangles.size() + triangulator.dropped_triangles() == corners.size() - 2);
        }
    }
}
