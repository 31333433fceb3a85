// What surfaces are made of: a table of named materials, and the surface that a material gives at a point
// (grain and rings are functions of space, so that nothing swims when the camera moves).
// Tested by tests/unit/trace/materials_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "frep/geom/scene.h"
#include "frep/math/vec.h"
#include "frep/trace/rgb.h"

namespace frep {

/// A material by name, for `frep render --material`.
struct NamedMaterial {
    enum class Pattern { none, grain, rings };

    std::string_view name;
    std::string_view doc;
    Material look;
    Pattern pattern = Pattern::none;
    bool uses_attributes = false;  ///< s[1..3] of the model are its color
};

/// The table, the default first.
std::span<const NamedMaterial> materials();
/// The material of that name (ASCII case-insensitive); nothing for others.
const NamedMaterial* find_material(std::string_view name);

namespace tracing {

/// A surface at a point, in linear light.
struct Surface {
    Rgb base;
    double metallic = 0, roughness = 0.5, clearcoat = 0;
};

/// `material` in the color `base` (linear) at `p`; `size` is the length of the object's diagonal, which
/// patterns are measured by.
Surface surface_at(const NamedMaterial& material, Rgb base, Vec3 p, double size);

}  // namespace tracing
}  // namespace frep
