// Small meshes for the tests of geom and io.
#pragma once

#include "frep/geom/mesh.h"

namespace frep::test {

/// The tetrahedron (0,0,0) (1,0,0) (0,1,0) (0,0,1): volume 1/6, outward oriented.
inline Mesh tetrahedron(Vec3 shift = {0, 0, 0}) {
    Mesh mesh;
    for (const Vec3 v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        mesh.vertices.push_back(v + shift);
    }
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

/// `a` and `b` as one mesh.
inline Mesh together(Mesh a, const Mesh& b) {
    const auto base = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (Triangle t : b.triangles) {
        for (std::uint32_t& v : t) v += base;
        a.triangles.push_back(t);
    }
    return a;
}

/// A square ring of n x m vertices wrapped to a torus: 2nm triangles, every vertex at its own position.
inline Mesh grid_torus(std::uint32_t n, std::uint32_t m) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < m; ++j) {
            mesh.vertices.push_back(
                {static_cast<double>(i), static_cast<double>(j), static_cast<double>(i * j)});
            const std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % m;
            mesh.triangles.push_back({i * m + j, i1 * m + j, i1 * m + j1});
            mesh.triangles.push_back({i * m + j, i1 * m + j1, i * m + j1});
        }
    }
    return mesh;
}

}  // namespace frep::test
