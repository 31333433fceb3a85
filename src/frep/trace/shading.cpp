// Implementation of shading.h.
#include "frep/trace/shading.h"

#include <algorithm>

#include "frep/math/functions.h"

namespace frep::tracing {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Directions spread evenly over the sphere: a spiral in steps of the golden angle.
std::vector<Vec3> spiral(int count) {
    std::vector<Vec3> out;
    for (int n = 0; n < count; ++n) {
        const double z = 1 - (2 * n + 1.0) / count;
        const double r = __builtin_sqrt(1 - z * z), angle = 2.39996322972865332 * n;
        out.push_back({r * math::cos(angle), r * math::sin(angle), z});
    }
    return out;
}

/// The cosine of the angle to a lamp of half-width `spread`, faded while the lamp sets at the horizon.
double lamp_cosine(double c, double spread) {
    if (c >= spread) return c;
    if (c <= -spread) return 0;
    return (c + spread) * (c + spread) / (4 * spread);
}

Vec3 mirrored(Vec3 to_eye, Vec3 n) { return n * (2 * dot(n, to_eye)) - to_eye; }

/// The share of light that a rough surface reflects over all directions, as scale and bias of F0.
struct Split {
    double scale, bias;
};
Split split_of(double roughness, double cosine) {
    const double power = math::exp(-6.43 * cosine);  // 2^(-9.28 cosine)
    const double r0 = 1 - roughness, r1 = 0.0425 - 0.0275 * roughness;
    const double r2 = 1.04 - 0.572 * roughness, r3 = 0.022 * roughness - 0.04;
    const double a004 = std::min(r0 * r0, power) * r0 + r1;
    return {-1.04 * a004 + r2, 1.04 * a004 + r3};
}

}  // namespace

Shader::Shader(const Stage& stage)
    : stage_(stage),
      directions_(spiral(stage.cones)),
      reach_(0.9 * stage.size),
      offset_(1.0 * stage.grid.step()) {}

/// The share of a lamp of half-width `spread` (at distance 1) that p sees.
double Shader::shadow(Vec3 p, Vec3 direction, double spread) const {
    const double step = stage_.grid.step();
    double seen = 1;
    double t = 0.5 * step;
    for (int n = 0; n < 96 && t < reach_; ++n) {
        const double d = stage_.grid.distance(p + direction * t);
        seen = std::min(seen, d / (spread * t));
        if (seen < -1) return 0;
        t += std::clamp(0.7 * d, 0.5 * step, 0.1 * reach_);
    }
    // From -1 (all hidden) to 1 (all seen), as the rim passes over a disk.
    return smooth_step(-1, 1, seen);
}

/// The share of a wide cone around `direction` that is free; `cosine` is that of its angle to the normal.
double Shader::cone(Vec3 p, Vec3 direction, double cosine) const {
    const double step = stage_.grid.step();
    const double tangent = std::min(0.45, cosine);
    double seen = 1;
    double t = 1.5 * step;
    const double reach = 0.5 * reach_;
    for (int n = 0; n < 14 && t < reach; ++n) {
        const double d = stage_.grid.distance(p + direction * t);
        const double fade = smooth_step(0.5, 1, t / reach);
        seen = std::min(seen, mix(d / (tangent * t), 1, fade));
        if (seen <= 0) return 0;
        t += std::max(0.8 * d, 0.35 * t);
    }
    return smooth_step(0, 1, seen);
}

Rgb Shader::dome_light(Vec3 p, Vec3 n) const {
    Rgb sum;
    double total = 0;
    for (const Vec3& d : directions_) {
        const double c = dot(d, n);
        if (c <= 0) continue;
        total += c;
        const double seen = cone(p, d, c);
        if (d.z < -0.05 && stage_.ground.is_there) {
            // The table under the object is in its own shadow.
            const double t = (p.z - stage_.ground.height) / -d.z;
            const Vec3 q = p + d * t;
            const double open = smooth_step(-0.02, 0.35, stage_.grid.distance(q) / stage_.size);
            sum += stage_.studio.table() * (c * seen * mix(0.25, 1, open) * 0.8);
            continue;
        }
        sum += stage_.studio.dome(d) * (c * seen);
    }
    return total > 0 ? sum * (1 / total) : sum;
}

Rgb Shader::lamp_light(Vec3 p, Vec3 n) const {
    Rgb sum;
    for (const Softbox& lamp : stage_.studio.lamps()) {
        const double c = lamp_cosine(dot(n, lamp.direction), lamp.spread());
        if (c <= 0) continue;
        const double seen = shadow(p, lamp.direction, lamp.spread());
        sum += lamp.radiance * (c * seen * lamp.solid_angle() / pi);
    }
    return sum;
}

bool Shader::meets_object(Vec3 p, Vec3 direction, double& t) const {
    const double step = stage_.grid.step();
    t = step;
    for (int n = 0; n < 80 && t < 2 * reach_; ++n) {
        const double d = stage_.grid.distance(p + direction * t);
        if (d < 0.05 * step) return true;
        t += std::max(0.9 * d, 0.15 * step);
    }
    return false;
}

/// The light of a point that is seen in a mirror: no shadows, no second mirror.
Rgb Shader::plain(Vec3 p, Vec3 n, Vec3 to_eye) const {
    const Surface s = surface_at(stage_.material, stage_.base, p, stage_.size);
    Rgb light = stage_.studio.dome(n) * mix(0.5, 1, clamped(0.5 + 0.5 * n.z));
    for (const Softbox& lamp : stage_.studio.lamps())
        light +=
            lamp.radiance * (lamp_cosine(dot(n, lamp.direction), lamp.spread()) * lamp.solid_angle() / pi);
    const double f = 0.04 + 0.96 * schlick(dot(n, to_eye));
    const Vec3 r = mirrored(to_eye, n);
    const Rgb around = stage_.studio.radiance(r, std::max(s.roughness, 0.15));
    if (s.metallic > 0.5) return s.base * around;
    return s.base * light + around * (f * (s.clearcoat > 0 ? s.clearcoat : 0.4));
}

Rgb Shader::reflected(Vec3 p, Vec3 n, Vec3 direction, double roughness) const {
    double t = 0;
    const Vec3 start = p + n * (0.5 * offset_);
    if (meets_object(start, direction, t)) {
        const Vec3 q = start + direction * t;
        const Vec3 m = stage_.grid.direction(q);
        return plain(q, m, -direction) * 0.8;
    }
    const double open = roughness > 0.1 ? shadow(p, direction, 0.1 + 0.6 * roughness * roughness) : 1;
    Rgb light = stage_.studio.radiance(direction, roughness);
    if (direction.z < 0 && stage_.ground.is_there) {
        const Vec3 q = p + direction * ((p.z - stage_.ground.height) / std::max(-direction.z, 1e-6));
        const double shade = smooth_step(-0.03, 0.30, stage_.grid.distance(q) / stage_.size);
        const Rgb table = stage_.studio.table() * mix(0.30, 1, shade);
        light = mix(light, table, smooth_step(0, 0.06 + roughness, -direction.z));
    }
    return light * mix(0.35, 1, open);
}

Rgb Shader::shade(const Surface& s, Vec3 p, Vec3 n, Vec3 to_eye) const {
    const Vec3 lifted = p + n * offset_;
    const double cosine = clamped(dot(n, to_eye));
    const Vec3 mirror = mirrored(to_eye, n);
    const double coat = s.clearcoat * (0.04 + 0.96 * schlick(cosine));
    Rgb out;
    if (s.metallic < 1) {
        const Rgb light = dome_light(lifted, n) + lamp_light(lifted, n);
        out += s.base * light * ((1 - s.metallic) * (1 - coat));
    }
    if (s.metallic > 0 || s.clearcoat < 1) {
        const Split split = split_of(s.roughness, cosine);
        const Rgb f0 = mix(Rgb{0.04, 0.04, 0.04}, s.base, s.metallic);
        const Rgb f = f0 * split.scale + Rgb{1, 1, 1} * split.bias;
        const Rgb around = reflected(p, n, mirror, s.roughness);
        out += around * f * (1 - s.clearcoat);
    }
    if (s.clearcoat > 0) out += reflected(p, n, mirror, 0.04) * coat;
    return out;
}

double Shader::ground_light(Vec3 p) const {
    const Vec3 up{0, 0, 1};
    const Vec3 lifted = p + up * (0.25 * offset_);
    double dome = 0, total = 0;
    for (const Vec3& d : directions_) {
        if (d.z <= 0.05) continue;
        total += d.z;
        dome += d.z * cone(lifted, d, d.z);
    }
    double lamps = 0, all = 0;
    for (const Softbox& lamp : stage_.studio.lamps()) {
        const double c = lamp.direction.z * luminance(lamp.radiance) * lamp.solid_angle();
        all += c;
        lamps += c * shadow(lifted, lamp.direction, lamp.spread());
    }
    return 0.5 * dome / total + 0.5 * lamps / all;
}

Shader::Reflection Shader::ground_reflection(Vec3 p, Vec3 direction) const {
    const Vec3 mirror{direction.x, direction.y, -direction.z};
    if (stage_.grid.distance(p) > 0.25 * stage_.size) return {};
    double t = 0;
    const Vec3 start = p + Vec3{0, 0, 0.3 * offset_};
    if (!meets_object(start, mirror, t)) return {};
    const Vec3 q = start + mirror * t;
    const double near = 1 - smooth_step(0, 0.22 * stage_.size, t);
    const double strength = (0.04 + 0.30 * schlick(mirror.z)) * near;
    const Vec3 n = stage_.grid.direction(q);
    // Seen at a grazing angle the object's rim would outshine the table: it is left out.
    return {plain(q, n, -mirror), strength * smooth_step(0, 0.3, -dot(n, mirror))};
}

}  // namespace frep::tracing
