// Implementation of scene.h.
#include "frep/geom/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace frep {

namespace {

struct UnitName {
    std::string_view text;
    LengthUnit unit;
};

constexpr LengthUnit micrometre{"um", 1e-6}, millimetre{"mm", 1e-3}, centimetre{"cm", 1e-2}, metre{"m", 1},
    inch{"inch", 0.0254}, foot{"ft", 0.3048};

constexpr std::array unit_names{
    UnitName{"um", micrometre},
    UnitName{"micron", micrometre},
    UnitName{"microns", micrometre},
    UnitName{"micrometre", micrometre},
    UnitName{"micrometres", micrometre},
    UnitName{"micrometer", micrometre},
    UnitName{"micrometers", micrometre},
    UnitName{"mm", millimetre},
    UnitName{"millimetre", millimetre},
    UnitName{"millimetres", millimetre},
    UnitName{"millimeter", millimetre},
    UnitName{"millimeters", millimetre},
    UnitName{"cm", centimetre},
    UnitName{"centimetre", centimetre},
    UnitName{"centimetres", centimetre},
    UnitName{"centimeter", centimetre},
    UnitName{"centimeters", centimetre},
    UnitName{"m", metre},
    UnitName{"metre", metre},
    UnitName{"metres", metre},
    UnitName{"meter", metre},
    UnitName{"meters", metre},
    UnitName{"in", inch},
    UnitName{"inch", inch},
    UnitName{"inches", inch},
    UnitName{"ft", foot},
    UnitName{"foot", foot},
    UnitName{"feet", foot},
};

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equal_any_case(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (lower(a[i]) != b[i]) return false;
    }
    return true;
}

}  // namespace

std::optional<LengthUnit> length_unit(std::string_view text) {
    for (const UnitName& entry : unit_names) {
        if (equal_any_case(text, entry.text)) return entry.unit;
    }
    return std::nullopt;
}

Mesh merged(const Scene& scene) {
    bool with_normals = true, with_colors = false;
    for (const SceneObject& object : scene.objects) {
        if (object.mesh.vertices.empty()) continue;
        with_normals = with_normals && !object.mesh.normals.empty();
        with_colors = with_colors || !object.mesh.colors.empty();
    }
    Mesh all;
    for (const SceneObject& object : scene.objects) {
        const Mesh& part = object.mesh;
        const auto offset = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        if (with_normals) all.normals.insert(all.normals.end(), part.normals.begin(), part.normals.end());
        if (with_colors) {
            all.colors.insert(all.colors.end(), part.colors.begin(), part.colors.end());
            all.colors.resize(all.vertices.size(), object.material.base);
        }
        for (const Triangle& t : part.triangles)
            all.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    return all;
}

}  // namespace frep
