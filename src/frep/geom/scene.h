// Scene: what an exchange file holds: one or more named meshes with how their surfaces look, the unit of
// their numbers and where they come from. Plain data.
// Tested by tests/unit/geom/scene_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/geom/color.h"
#include "frep/geom/mesh.h"

namespace frep {

/// How a surface looks, by the metallic-roughness model of glTF 2.0 (3.9.2) and KHR_materials_clearcoat.
struct Material {
    Color base{0.78, 0.76, 0.72};  ///< sRGB; multiplied with the colors of the vertices where a mesh has them
    double metallic = 0;           ///< 0..1
    double roughness = 0.5;        ///< 0..1
    double clearcoat = 0;          ///< 0..1, the strength of a polished coat of lacquer
};

/// A length unit of the real world.
struct LengthUnit {
    std::string_view name;  ///< "mm"
    double metres = 0.001;  ///< length of one unit
};

/// The unit that `text` names (um, mm, cm, m, inch, ft and their long names, any case); nothing for others.
std::optional<LengthUnit> length_unit(std::string_view text);

struct SceneObject {
    std::string name;  ///< UTF-8; may be empty
    Mesh mesh;         ///< model space: right-handed, Z up
    Material material;
};

struct Scene {
    std::vector<SceneObject> objects;
    LengthUnit unit{"mm", 0.001};
    std::string title, author, license, source;  ///< UTF-8; may be empty
};

/// The objects' meshes as one; normals and colors stay where every part has them (objects without colors
/// take their material's base color when another has some). Fewer than 2^32 vertices in all.
Mesh merged(const Scene& scene);

}  // namespace frep
