// Implementation of the verbs of mesh.h. Merging looks positions up in an open-addressing table which is
// never iterated, so the result depends on the order of the vertices only.
#include "frep/geom/mesh.h"

#include <bit>
#include <cstddef>
#include <limits>

#include "frep/base/result.h"

namespace frep {

namespace {

constexpr std::uint32_t no_vertex = 0xffffffffu;

std::uint64_t mix(std::uint64_t h, double value) {
    h ^= std::bit_cast<std::uint64_t>(value);
    h *= 0x9e3779b97f4a7c15u;
    return h ^ (h >> 29);
}

std::uint64_t position_hash(const Vec3& p) { return mix(mix(mix(0x51ed270b, p.x), p.y), p.z); }

bool same_bits(const Vec3& a, const Vec3& b) {
    return std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
           std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y) &&
           std::bit_cast<std::uint64_t>(a.z) == std::bit_cast<std::uint64_t>(b.z);
}

double written(double value, bool as_float32) {
    return (as_float32 ? rounded_to_binary32(value) : value) + 0.0;  // -0 becomes +0
}

Vec3 written(const Vec3& p, bool as_float32) {
    return {written(p.x, as_float32), written(p.y, as_float32), written(p.z, as_float32)};
}

}  // namespace

[[gnu::noinline]] double rounded_to_binary32(double value) {
    return static_cast<double>(static_cast<float>(value));
}

bool is_valid(const Mesh& mesh) {
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.vertices.size()) return false;
    if (!mesh.colors.empty() && mesh.colors.size() != mesh.vertices.size()) return false;
    if (mesh.vertices.size() > no_vertex) return false;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            if (v >= mesh.vertices.size()) return false;
        }
    }
    return true;
}

Mesh merge_equal_positions(const Mesh& mesh, const MergeOptions& options) {
    FREP_CHECK(is_valid(mesh));
    const std::size_t count = mesh.vertices.size();
    const bool with_normals = !mesh.normals.empty(), with_colors = !mesh.colors.empty();
    Mesh merged;
    merged.vertices.reserve(count);
    if (with_normals) merged.normals.reserve(count);
    if (with_colors) merged.colors.reserve(count);
    std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 2), no_vertex);
    const std::size_t mask = table.size() - 1;
    std::vector<std::uint32_t> target(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = written(mesh.vertices[i], options.as_float32);
        std::size_t slot = position_hash(p) & mask;
        while (table[slot] != no_vertex && !same_bits(merged.vertices[table[slot]], p))
            slot = (slot + 1) & mask;
        if (table[slot] == no_vertex) {
            table[slot] = static_cast<std::uint32_t>(merged.vertices.size());
            merged.vertices.push_back(p);
            if (with_normals) merged.normals.push_back(mesh.normals[i]);
            if (with_colors) merged.colors.push_back(mesh.colors[i]);
        }
        target[i] = table[slot];
    }
    merged.triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        const Triangle moved{target[t[0]], target[t[1]], target[t[2]]};
        if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
        merged.triangles.push_back(moved);
    }
    return merged;
}

bool collapses(const Mesh& mesh, const Triangle& t, const MergeOptions& options) {
    const Vec3 a = written(mesh.vertices[t[0]], options.as_float32);
    const Vec3 b = written(mesh.vertices[t[1]], options.as_float32);
    const Vec3 c = written(mesh.vertices[t[2]], options.as_float32);
    return same_bits(a, b) || same_bits(b, c) || same_bits(c, a);
}

std::vector<Vec3> mean_normals(const Mesh& mesh) {
    FREP_CHECK(is_valid(mesh));
    std::vector<Vec3> sums(mesh.vertices.size(), Vec3{0, 0, 0});
    for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 n = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        for (const std::uint32_t v : t) sums[v] = sums[v] + n;
    }
    for (Vec3& n : sums) {
        const double size = length(n);
        const bool usable = size > 0 && size <= std::numeric_limits<double>::max();
        n = usable ? n / size : Vec3{0, 0, 0};
    }
    return sums;
}

}  // namespace frep
