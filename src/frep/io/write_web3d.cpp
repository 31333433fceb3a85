// Implementation of write_web3d.h.
#include "frep/io/write_web3d.h"

#include <algorithm>

namespace frep::encode {

PhongMaterial phong_material(const Material& m) {
    const double gray = (1 - m.metallic) * (0.4 * (1 - m.roughness) + 0.4 * m.clearcoat);
    const auto mixed = [&](double base) { return std::clamp(gray + m.metallic * base, 0.0, 1.0); };
    const double dark = 1 - 0.5 * m.metallic;
    PhongMaterial phong;
    phong.diffuse = {std::clamp(dark * m.base.r, 0.0, 1.0), std::clamp(dark * m.base.g, 0.0, 1.0),
                     std::clamp(dark * m.base.b, 0.0, 1.0)};
    phong.specular = {mixed(m.base.r), mixed(m.base.g), mixed(m.base.b)};
    phong.shininess = std::clamp(std::max(1 - m.roughness, 0.9 * m.clearcoat), 0.02, 1.0);
    return phong;
}

}  // namespace frep::encode
