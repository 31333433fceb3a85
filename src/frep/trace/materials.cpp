// Implementation of materials.h.
#include "frep/trace/materials.h"

#include <array>
#include <cstdint>

#include "frep/base/source.h"
#include "frep/math/functions.h"

namespace frep {

namespace {

using Pattern = NamedMaterial::Pattern;

constexpr std::array table{
    NamedMaterial{"clay", "matt modelling clay (the default)", {{0.80, 0.73, 0.65}, 0, 0.85, 0}},
    NamedMaterial{"lacquer",
                  "polished lacquer, deep red unless the model has a color",
                  {{0.55, 0.04, 0.03}, 0, 0.5, 1}},
    NamedMaterial{"metal", "brushed brass, or metal of the model's color", {{0.89, 0.70, 0.40}, 1, 0.3, 0}},
    NamedMaterial{"stone", "grey stone with a fine grain", {{0.62, 0.60, 0.57}, 0, 0.75, 0}, Pattern::grain},
    NamedMaterial{"porcelain", "white glazed porcelain", {{0.92, 0.93, 0.93}, 0, 0.6, 1}},
    NamedMaterial{"wood", "oiled wood with annual rings", {{0.55, 0.36, 0.20}, 0, 0.5, 0.25}, Pattern::rings},
    NamedMaterial{"skin",
                  "the model's own colors: attributes s[1..3] are red, green, blue",
                  {{0.78, 0.76, 0.72}, 0, 0.5, 0},
                  Pattern::none,
                  true},
};

}  // namespace

std::span<const NamedMaterial> materials() { return table; }

const NamedMaterial* find_material(std::string_view name) {
    const std::string wanted = lower_case(name);
    for (const NamedMaterial& material : table)
        if (material.name == wanted) return &material;
    return nullptr;
}

namespace tracing {

namespace {

/// A number 0..1 of a lattice point: the bits mixed after Steele, Lea and Flood 2014 ("SplitMix").
double lattice_number(std::int64_t i, std::int64_t j, std::int64_t k) {
    auto h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ULL ^
             static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fULL ^
             static_cast<std::uint64_t>(k) * 0x165667b19e3779f9ULL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    h ^= h >> 31;
    return static_cast<double>(h >> 11) * 0x1p-53;
}

/// Smooth noise 0..1 with features of size 1.
double noise(Vec3 p) {
    const double fx = __builtin_floor(p.x), fy = __builtin_floor(p.y), fz = __builtin_floor(p.z);
    const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy),
               k = static_cast<std::int64_t>(fz);
    const double a = smooth_step(0, 1, p.x - fx), b = smooth_step(0, 1, p.y - fy),
                 c = smooth_step(0, 1, p.z - fz);
    const auto edge = [&](std::int64_t dj, std::int64_t dk) {
        return mix(lattice_number(i, j + dj, k + dk), lattice_number(i + 1, j + dj, k + dk), a);
    };
    return mix(mix(edge(0, 0), edge(1, 0), b), mix(edge(0, 1), edge(1, 1), b), c);
}

/// Noise of several sizes, about 0..1.
double cloudy(Vec3 p, int octaves) {
    double sum = 0, weight = 0.5, total = 0;
    for (int n = 0; n < octaves; ++n) {
        sum += weight * noise(p);
        total += weight;
        weight *= 0.55;
        p = p * 2.03 + Vec3{17.1, 5.3, 11.7};
    }
    return sum / total;
}

}  // namespace

Surface surface_at(const NamedMaterial& material, Rgb base, Vec3 p, double size) {
    Surface s{base, material.look.metallic, material.look.roughness, material.look.clearcoat};
    const Vec3 q = p * (1 / size);
    if (material.pattern == Pattern::grain) {
        const double clouds = cloudy(q * 9, 4), grain = cloudy(q * 160, 2);
        s.base = s.base * (0.62 + 0.42 * clouds + 0.30 * (grain - 0.5));
        if (grain > 0.68) s.base = mix(s.base, {0.75, 0.74, 0.72}, smooth_step(0.68, 0.80, grain) * 0.7);
        if (grain < 0.30) s.base = s.base * mix(1.0, 0.45, smooth_step(0.30, 0.18, grain));
        s.roughness = clamped(s.roughness + 0.2 * (grain - 0.5));
    }
    if (material.pattern == Pattern::rings) {
        // The trunk stands a little askew beside the object, its rings are wavy, its fibres run along it.
        const Vec3 w = q + Vec3{0.35, 0.22, 0} + Vec3{0.12, 0.05, 0} * q.z;
        const double wave = 0.05 * (cloudy(Vec3{w.x * 4, w.y * 4, w.z * 1.2}, 3) - 0.5);
        const double ring = (__builtin_sqrt(w.x * w.x + w.y * w.y) + wave) * 26;
        const double phase = ring - __builtin_floor(ring);
        const double late = smooth_step(0.35, 0.92, phase) * (1 - smooth_step(0.94, 1.0, phase));
        const double fibre = cloudy({w.x * 240, w.y * 240, w.z * 9}, 2);
        s.base = mix(s.base * 1.18, s.base * Rgb{0.62, 0.55, 0.48}, 0.75 * late);
        s.base = s.base * (0.88 + 0.24 * fibre);
    }
    return s;
}

}  // namespace tracing
}  // namespace frep
