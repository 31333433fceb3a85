// Implementation of cell.h. Face branches are directed so that every node has one branch in and one out; the
// cycles of that permutation are the polygons, oriented outward without a further test.
#include "frep/contour/cell.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace frep::contouring {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Corners of each face counter-clockwise seen from outside the cell, and the edges that follow them.
struct Face {
    std::array<std::uint8_t, 4> corners;
    std::array<std::uint8_t, 4> edges;
};
constexpr std::array<Face, 6> faces{{{{0, 3, 2, 1}, {3, 2, 1, 0}},
                                     {{4, 5, 6, 7}, {4, 5, 6, 7}},
                                     {{0, 1, 5, 4}, {0, 9, 4, 8}},
                                     {{3, 7, 6, 2}, {11, 6, 10, 2}},
                                     {{0, 4, 7, 3}, {8, 7, 11, 3}},
                                     {{1, 2, 6, 5}, {1, 10, 5, 9}}}};

/// For each edge the set of its two faces as bits.
constexpr std::array<std::uint8_t, 12> edge_faces = [] {
    std::array<std::uint8_t, 12> sets{};
    for (unsigned f = 0; f < 6; ++f) {
        for (const std::uint8_t e : faces[f].edges) sets[e] = static_cast<std::uint8_t>(sets[e] | 1u << f);
    }
    return sets;
}();

/// The face's four signs as bits, in its order of corners.
unsigned face_signs(const Face& face, unsigned inside) {
    unsigned signs = 0;
    for (unsigned k = 0; k < 4; ++k) signs |= ((inside >> face.corners[k]) & 1u) << k;
    return signs;
}

bool is_ambiguous(unsigned signs) { return signs == 0b0101 || signs == 0b1010; }

/// next[e] = the node that follows the node of edge e on its polygon. `joined` has a bit for each ambiguous
/// face whose inside corners are joined.
std::array<std::uint8_t, 12> link_nodes(unsigned inside, unsigned joined) {
    std::array<std::uint8_t, 12> next{};
    for (unsigned f = 0; f < 6; ++f) {
        const Face& face = faces[f];
        const unsigned signs = face_signs(face, inside);
        const auto corner = [&](unsigned k) { return (signs >> (k % 4)) & 1u; };
        // Edge k runs from corner k to corner k + 1. Each edge entering the inside is linked to one leaving
        // it: the only one, or on an ambiguous face the next one (around the inside corner) or the one before
        // (around the outside corner).
        const unsigned step = is_ambiguous(signs) && ((joined >> f) & 1u) ? 3 : 1;
        for (unsigned k = 0; k < 4; ++k) {
            if (corner(k) || !corner(k + 1)) continue;
            unsigned to = (k + step) % 4;
            while (!(corner(to) && !corner(to + 1))) to = (to + 1) % 4;
            next[face.edges[k]] = face.edges[to];
        }
    }
    return next;
}

CellPolygons trace(unsigned inside, unsigned joined) {
    const std::array<std::uint8_t, 12> next = link_nodes(inside, joined);
    CellPolygons polygons;
    unsigned left = 0;
    for (unsigned e = 0; e < 12; ++e) {
        const unsigned a = (inside >> edge_corners[e][0]) & 1u;
        const unsigned b = (inside >> edge_corners[e][1]) & 1u;
        if (a != b) left |= 1u << e;
    }
    std::size_t filled = 0;
    while (left != 0) {
        auto e = static_cast<std::uint8_t>(std::countr_zero(left));
        std::uint8_t length = 0;
        for (; left & (1u << e); e = next[e], ++length) {
            left &= ~(1u << e);
            polygons.edges[filled++] = e;
        }
        polygons.lengths[polygons.count++] = length;
    }
    return polygons;
}

/// The polygons of every sign pattern; right for those without an ambiguous face.
const std::array<CellPolygons, 256>& plain_patterns() {
    static const std::array<CellPolygons, 256> table = [] {
        std::array<CellPolygons, 256> all;
        for (unsigned inside = 0; inside < 256; ++inside) all[inside] = trace(inside, 0);
        return all;
    }();
    return table;
}

}  // namespace

bool face_joins_inside(double a, double b, double c, double d) {
    // The saddle value is (ab - cd) / (a + b - c - d) with a positive denominator.
    if (c != c || d != d) return false;
    double inner = a * b;
    double outer = c * d;
    const auto safe = [](double product) { return product > 1e-290 && product < 1e290; };
    if (!safe(inner) || !safe(outer)) {
        const double largest = std::max(std::max(a, b), std::max(-c, -d));
        if (largest > 0 && largest < infinity) {
            int exponent = 0;
            std::frexp(largest, &exponent);
            inner = std::ldexp(a, -exponent) * std::ldexp(b, -exponent);
            outer = std::ldexp(c, -exponent) * std::ldexp(d, -exponent);
        }
    }
    if (inner != inner) inner = 0;  // 0 * inf: a corner on the surface
    return inner >= outer;
}

bool has_ambiguous_face(unsigned inside) {
    for (const Face& face : faces)
        if (is_ambiguous(face_signs(face, inside))) return true;
    return false;
}

CellPolygons trace_cell(const std::array<double, 8>& values) {
    unsigned inside = 0;
    for (unsigned i = 0; i < 8; ++i) inside |= (values[i] >= 0 ? 1u : 0u) << i;
    unsigned joined = 0;
    bool ambiguous = false;
    for (unsigned f = 0; f < 6; ++f) {
        const unsigned signs = face_signs(faces[f], inside);
        if (!is_ambiguous(signs)) continue;
        ambiguous = true;
        const std::array<std::uint8_t, 4>& c = faces[f].corners;
        const unsigned first = signs == 0b0101 ? 0 : 1;  // the first inside corner
        if (face_joins_inside(values[c[first]], values[c[first + 2]], values[c[first + 1]],
                              values[c[(first + 3) % 4]])) {
            joined |= 1u << f;
        }
    }
    return ambiguous ? trace(inside, joined) : plain_patterns()[inside];
}

bool share_face(int edge_a, int edge_b) {
    return (edge_faces[static_cast<std::size_t>(edge_a)] & edge_faces[static_cast<std::size_t>(edge_b)]) != 0;
}

bool triangulate(std::span<const std::uint8_t> edges, std::vector<std::array<std::uint8_t, 3>>& triangles) {
    const auto n = static_cast<std::uint8_t>(edges.size());
    const std::size_t old_size = triangles.size();
    std::array<std::uint8_t, 12> left{};  // the nodes not cut off yet
    std::size_t count = n;
    for (std::uint8_t i = 0; i < n; ++i) left[i] = i;
    while (count > 3) {
        std::size_t i = 0;
        while (i < count && share_face(edges[left[i]], edges[left[(i + 2) % count]])) ++i;
        if (i == count) break;
        const std::size_t ear = (i + 1) % count;
        triangles.push_back({left[i], left[ear], left[(i + 2) % count]});
        std::copy(left.begin() + ear + 1, left.begin() + count, left.begin() + ear);
        --count;
    }
    if (count == 3) {
        triangles.push_back({left[0], left[1], left[2]});
        return false;
    }
    triangles.resize(old_size);
    for (std::uint8_t i = 0; i < n; ++i) triangles.push_back({i, static_cast<std::uint8_t>((i + 1) % n), n});
    return true;
}

}  // namespace frep::contouring
