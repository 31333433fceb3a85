// OFF and COFF, the Geomview object file format: text, coordinates in binary64, colors as four components
// 0..1 with a point in each (readers take a number without one for 0..255). See mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

/// A component 0..1 with four decimals: 0.5000.
void append_component(std::string& out, double value) {
    const double share = !(value > 0) ? 0 : value > 1 ? 1 : value;
    const int steps = static_cast<int>(share * 10000 + 0.5);
    const std::string digits = std::to_string(10000 + steps % 10000);
    out += steps >= 10000 ? " 1." : " 0.";
    out.append(digits, 1);
}

}  // namespace

std::string write_off(const SceneView& scene) {
    std::size_t vertices = 0, triangles = 0;
    bool colored = false;
    for (const ObjectView& object : scene.objects) {
        vertices += object.mesh->vertices.size();
        triangles += object.mesh->triangles.size();
        colored = colored || !object.mesh->colors.empty();
    }
    std::string out = colored ? "COFF\n" : "OFF\n";
    append_number(out, vertices);
    out.push_back(' ');
    append_number(out, triangles);
    out += " 0\n";
    for (const ObjectView& object : scene.objects) {
        for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
            append_numbers<double>(out, object.mesh->vertices[i]);
            if (colored) {
                const Color color = vertex_color(object, i);
                append_component(out, color.r);
                append_component(out, color.g);
                append_component(out, color.b);
                out += " 1.0";
            }
            out.push_back('\n');
        }
    }
    std::size_t first = 0;
    for (const ObjectView& object : scene.objects) {
        for (const Triangle& t : object.mesh->triangles) {
            out.push_back('3');
            for (const std::uint32_t v : t) {
                out.push_back(' ');
                append_number(out, v + first);
            }
            out.push_back('\n');
        }
        first += object.mesh->vertices.size();
    }
    return out;
}

}  // namespace frep::encode
