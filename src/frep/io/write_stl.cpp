// STL, 3D Systems stereolithography: binary or text, binary32, one normal a facet, no unit. See
// mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

std::string write_text(const SceneView& scene) {
    std::string out = "solid frep\n";
    for (const ObjectView& object : scene.objects) {
        for (const Triangle& t : object.mesh->triangles) {
            out += "facet normal ";
            append_numbers<float>(out, facet_normal(*object.mesh, t));
            out += "\n outer loop\n";
            for (const std::uint32_t v : t) {
                out += "  vertex ";
                append_numbers<float>(out, object.mesh->vertices[v]);
                out.push_back('\n');
            }
            out += " endloop\nendfacet\n";
        }
    }
    out += "endsolid frep\n";
    return out;
}

std::string write_binary(const SceneView& scene) {
    std::size_t count = 0;
    for (const ObjectView& object : scene.objects) count += object.mesh->triangles.size();
    std::string out = "frep: binary STL, little endian, lengths in model units";
    out.resize(80, ' ');
    out.reserve(84 + 50 * count);
    append_little_endian(out, static_cast<std::uint32_t>(count));
    for (const ObjectView& object : scene.objects) {
        for (const Triangle& t : object.mesh->triangles) {
            append_vector(out, facet_normal(*object.mesh, t));
            for (const std::uint32_t v : t) append_vector(out, object.mesh->vertices[v]);
            append_little_endian(out, 0, 2);  // attribute byte count
        }
    }
    return out;
}

}  // namespace

std::string write_stl(const SceneView& scene, bool ascii) {
    return ascii ? write_text(scene) : write_binary(scene);
}

}  // namespace frep::encode
