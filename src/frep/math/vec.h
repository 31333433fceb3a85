// Points, vectors and boxes of space, plain structs. Checked by tests/unit/math/vec_test.cpp.
#pragma once

namespace frep {

/// A point or a vector, in model units.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(double s, Vec3 a) { return a * s; }
    friend constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
    friend constexpr bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

/// The scalar product.
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// The vector product.
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The Euclidean length; may overflow above 1e154.
inline double length(Vec3 a) { return __builtin_sqrt(dot(a, a)); }

/// A point or a vector of the plane, in model units.
struct Vec2 {
    double x = 0, y = 0;

    friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vec2 operator*(Vec2 a, double s) { return {a.x * s, a.y * s}; }
    friend constexpr bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
};

/// An axis-parallel box from `min` to `max`.
struct Box3 {
    Vec3 min, max;

    /// The cube [-half, half]^3.
    static constexpr Box3 cube(double half) { return {{-half, -half, -half}, {half, half, half}}; }
    /// The length of the diagonal.
    double diagonal() const { return length(max - min); }
    /// True if the closed box contains p.
    constexpr bool contains(Vec3 p) const {
        return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
    }
    friend constexpr bool operator==(const Box3& a, const Box3& b) {
        return a.min == b.min && a.max == b.max;
    }
};

/// The smallest box around two.
constexpr Box3 joined(const Box3& a, const Box3& b) {
    const auto lesser = [](double u, double v) { return v < u ? v : u; };
    const auto greater = [](double u, double v) { return u < v ? v : u; };
    return {{lesser(a.min.x, b.min.x), lesser(a.min.y, b.min.y), lesser(a.min.z, b.min.z)},
            {greater(a.max.x, b.max.x), greater(a.max.y, b.max.y), greater(a.max.z, b.max.z)}};
}

}  // namespace frep
