// A plane of space that is parallel to two axes, and rectangles in it: what outlines and pictures of plane
// sections share. Tested by tests/unit/trace/plane_window_test.cpp.
#pragma once

#include <array>
#include <cstddef>

#include "frep/math/vec.h"

namespace frep {

/// A plane parallel to two axes of space (0, 1, 2 for x, y, z), with its directions on paper.
struct Plane {
    int right = 0, up = 1;  ///< two different axes
    double at = 0;          ///< the coordinate of the plane on the third axis, model units

    int normal() const { return 3 - right - up; }

    /// The plane where the axis `normal` is `at`; the other two axes in the order of the alphabet are its
    /// right and up.
    static constexpr Plane across(int normal, double at) {
        return {normal == 0 ? 1 : 0, normal == 2 ? 1 : 2, at};
    }
    /// The point of space at a point of the plane.
    Vec3 point(Vec2 p) const {
        std::array<double, 3> axes{at, at, at};
        axes[static_cast<std::size_t>(right)] = p.x;
        axes[static_cast<std::size_t>(up)] = p.y;
        return {axes[0], axes[1], axes[2]};
    }
    /// The point of the plane below or above a point of space.
    Vec2 flat(Vec3 p) const {
        const std::array<double, 3> axes{p.x, p.y, p.z};
        return {axes[static_cast<std::size_t>(right)], axes[static_cast<std::size_t>(up)]};
    }
};

/// A rectangle of a plane, in model units.
struct Rectangle {
    Vec2 min, max;
    double width() const { return max.x - min.x; }
    double height() const { return max.y - min.y; }
};

}  // namespace frep
