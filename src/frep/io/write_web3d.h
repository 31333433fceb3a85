// What VRML 97 and X3D have in common (private to io): lengths in metres, Y up, and Phong materials.
#pragma once

#include "frep/io/writers.h"

namespace frep::encode {

/// (x, y, z) -> (x, z, -y), scaled.
inline Vec3 y_up(const Vec3& p, double scale) { return {p.x * scale, p.z * scale, -p.y * scale}; }

/// The numbers of a Material node: an approximation of the metallic-roughness model.
struct PhongMaterial {
    Color diffuse, specular;
    double shininess = 0;  ///< 0..1
};
PhongMaterial phong_material(const Material& material);

}  // namespace frep::encode
