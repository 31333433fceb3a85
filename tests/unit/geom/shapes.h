// Small meshes for the tests of geom and io.
#pragma once

#include <utility>

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

/// The box from `min` to `max`: 12 triangles, outward oriented.
inline Mesh box(Vec3 min, Vec3 max) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back(
            {(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// The filled cells of a rectilinear grid with the planes xs, ys, zs, as a closed mesh: two triangles for
/// each side between a filled cell and an empty one. `filled(i, j, k)` tells of the cell behind plane i, j,
/// k.
template <class Filled>
Mesh cell_solid(const std::vector<double>& xs, const std::vector<double>& ys, const std::vector<double>& zs,
                Filled filled) {
    const int counts[3] = {static_cast<int>(xs.size()), static_cast<int>(ys.size()),
                           static_cast<int>(zs.size())};
    const auto is_filled = [&](const int(&c)[3]) {
        for (int a = 0; a < 3; ++a) {
            if (c[a] < 0 || c[a] + 1 >= counts[a]) return false;
        }
        return static_cast<bool>(filled(c[0], c[1], c[2]));
    };
    Mesh mesh;
    const auto corner = [&](const int(&c)[3]) {
        mesh.vertices.push_back({xs[static_cast<std::size_t>(c[0])], ys[static_cast<std::size_t>(c[1])],
                                 zs[static_cast<std::size_t>(c[2])]});
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    for (int n = 0; n < counts[0] * counts[1] * counts[2]; ++n) {
        const int cell[3] = {n % counts[0], n / counts[0] % counts[1], n / counts[0] / counts[1]};
        if (!is_filled(cell)) continue;
        for (int side = 0; side < 6; ++side) {
            const int a = side / 2, u = (a + 1) % 3, v = (a + 2) % 3;
            int beside[3] = {cell[0], cell[1], cell[2]}, at[3] = {cell[0], cell[1], cell[2]};
            beside[a] += side % 2 == 1 ? 1 : -1;
            if (is_filled(beside)) continue;
            at[a] += side % 2;
            std::array<std::uint32_t, 4> quad{};
            for (std::size_t k = 0; k < 4; ++k) {
                int p[3] = {at[0], at[1], at[2]};
                p[u] += k == 1 || k == 2 ? 1 : 0;
                p[v] += k >= 2 ? 1 : 0;
                quad[k] = corner(p);
            }
            if (side % 2 == 0) std::swap(quad[1], quad[3]);
            mesh.triangles.push_back({quad[0], quad[1], quad[2]});
            mesh.triangles.push_back({quad[0], quad[2], quad[3]});
        }
    }
    return merge_equal_positions(mesh);
}

/// The mesh with its other side outward.
inline Mesh turned_inside_out(Mesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

/// A sphere: an octahedron whose triangles are split in four `levels` times; 8 * 4^levels triangles. The
/// vertices lie on the sphere; the split edges' middles are not shared before merging.
inline Mesh sphere(Vec3 center, double radius, int levels) {
    std::vector<std::array<Vec3, 3>> faces;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                std::array<Vec3, 3> face{Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}};
                if (x * y * z < 0) std::swap(face[1], face[2]);
                faces.push_back(face);
            }
        }
    }
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<Vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const Vec3 p = (b + c) / length(b + c), q = (c + a) / length(c + a), r = (a + b) / length(a + b);
            finer.insert(finer.end(), {{a, r, q}, {r, b, p}, {q, p, c}, {p, q, r}});
        }
        faces = finer;
    }
    Mesh mesh;
    for (const auto& face : faces) {
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec3& p : face) mesh.vertices.push_back(center + p * radius);
        mesh.triangles.push_back({base, base + 1, base + 2});
    }
    return mesh;
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
