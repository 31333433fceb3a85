// What several writers need; see writers.h.
#include "frep/io/writers.h"

#include <algorithm>
#include <limits>

namespace frep::encode {

namespace {

/// Inside 0..1; 0 for NaN.
double share(double value) { return !(value > 0) ? 0 : value > 1 ? 1 : value; }

}  // namespace

Color vertex_color(const ObjectView& object, std::size_t i) {
    const Color& base = object.material.base;
    if (object.mesh->colors.empty()) return base;
    const Color& raw = object.mesh->colors[i];
    const Color own{share(raw.r), share(raw.g), share(raw.b)};
    if (base == Color{1, 1, 1}) return own;
    const Color a = linear_from_srgb(base), b = linear_from_srgb(own);
    return srgb_from_linear({a.r * b.r, a.g * b.g, a.b * b.b});
}

Vec3 unit_or_zero(Vec3 n) {
    const double size = length(n);
    return size > 0 && size <= std::numeric_limits<double>::max() ? n / size : Vec3{0, 0, 0};
}

std::vector<Vec3> unit_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.normals.size());
    bool complete = true;
    for (const Vec3& n : mesh.normals) {
        normals.push_back(unit_or_zero(n));
        complete = complete && !(normals.back() == Vec3{0, 0, 0});
    }
    if (complete) return normals;
    const std::vector<Vec3> means = mean_normals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (normals[i] == Vec3{0, 0, 0}) normals[i] = means[i];
        if (normals[i] == Vec3{0, 0, 0}) normals[i] = {0, 0, 1};
    }
    return normals;
}

Vec3 facet_normal(const Mesh& mesh, const Triangle& t) {
    const Vec3 a = mesh.vertices[t[0]];
    return unit_or_zero(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
}

std::vector<Triangle> proper_triangles(const std::vector<Triangle>& triangles) {
    std::vector<Triangle> proper;
    proper.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) proper.push_back(t);
    }
    return proper;
}

bool is_closed(const std::vector<Triangle>& triangles) {
    // An edge is its two vertices, the smaller first, and the direction in the lowest bit.
    struct Edge {
        std::uint32_t low, high;
        bool falling;
        bool operator<(const Edge& b) const {
            return low != b.low ? low < b.low : high != b.high ? high < b.high : falling < b.falling;
        }
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a > b});
        }
    }
    std::sort(edges.begin(), edges.end());
    if (edges.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const Edge &up = edges[i], &down = edges[i + 1];
        if (up.low != down.low || up.high != down.high || up.falling || !down.falling) return false;
        const bool again = i > 0 && edges[i - 1].low == up.low && edges[i - 1].high == up.high;
        if (again) return false;
    }
    return !edges.empty();
}

std::uint32_t color_bits(const Color& color) {
    return std::uint32_t{color_byte(color.r)} << 16 | std::uint32_t{color_byte(color.g)} << 8 |
           color_byte(color.b);
}

Palette palette_of(const ObjectView& object) {
    Palette palette;
    palette.colors.reserve(object.mesh->vertices.size());
    for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
        palette.colors.push_back(color_bits(vertex_color(object, i)));
    }
    std::sort(palette.colors.begin(), palette.colors.end());
    palette.colors.erase(std::unique(palette.colors.begin(), palette.colors.end()), palette.colors.end());
    return palette;
}

std::uint32_t Palette::index(std::uint32_t color) const {
    return static_cast<std::uint32_t>(std::lower_bound(colors.begin(), colors.end(), color) - colors.begin());
}

void append_hex_color(std::string& out, std::uint32_t color) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    out.push_back('#');
    for (int shift = 20; shift >= 0; shift -= 4) out.push_back(digits[(color >> shift) & 15u]);
}

}  // namespace frep::encode
