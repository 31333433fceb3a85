// VRML 97 (ISO/IEC 14772-1:1997): a Group an object, metres, Y up. The names of objects stand as DEF,
// reduced to identifiers, and in full in a WorldInfo. See mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/write_web3d.h"

namespace frep::encode {

namespace {

void append_color(std::string& out, const Color& color) {
    append_numbers<float>(out, {color.r, color.g, color.b});
}

void append_world(std::string& out, const SceneView& scene) {
    if (scene.title.empty() && scene.author.empty() && scene.license.empty() && scene.source.empty()) return;
    out += "WorldInfo {\n title ";
    append_quoted(out, scene.title);
    out += "\n info [";
    const auto info = [&out](std::string_view key, std::string_view text) {
        if (text.empty()) return;
        out.push_back(' ');
        append_quoted(out, std::string(key) + ": " + std::string(text));
    };
    info("author", scene.author);
    info("license", scene.license);
    info("source", scene.source);
    out += " ]\n}\n";
}

void append_material(std::string& out, const Material& material) {
    const PhongMaterial phong = phong_material(material);
    out += "   appearance Appearance { material Material { diffuseColor ";
    append_color(out, phong.diffuse);
    out += " specularColor ";
    append_color(out, phong.specular);
    out += " shininess ";
    append_real(out, phong.shininess);
    out += " } }\n";
}

void append_geometry(std::string& out, const ObjectView& object, const std::vector<Triangle>& triangles,
                     double metres) {
    const Mesh& mesh = *object.mesh;
    out += "   geometry IndexedFaceSet {\n    solid FALSE\n    coord Coordinate { point [\n";
    for (const Vec3& v : mesh.vertices) {
        append_numbers<float>(out, y_up(v, metres));
        out += ",\n";
    }
    out += "    ] }\n";
    if (!mesh.normals.empty()) {
        out += "    normal Normal { vector [\n";
        for (const Vec3& n : unit_normals(mesh)) {
            append_numbers<float>(out, y_up(n, 1));
            out += ",\n";
        }
        out += "    ] }\n";
    }
    if (!mesh.colors.empty()) {
        out += "    color Color { color [\n";
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            append_color(out, vertex_color(object, i));
            out += ",\n";
        }
        out += "    ] }\n";
    }
    out += "    coordIndex [\n";
    for (const Triangle& t : triangles) {
        for (const std::uint32_t v : t) {
            append_number(out, v);
            out.push_back(' ');
        }
        out += "-1\n";
    }
    out += "    ]\n   }\n";
}

}  // namespace

std::string write_vrml(const SceneView& scene) {
    std::string out = "#VRML V2.0 utf8\n# frep\n";
    append_world(out, scene);
    UniqueNames names;
    for (const ObjectView& object : scene.objects) {
        const std::vector<Triangle> triangles = proper_triangles(object.mesh->triangles);
        if (triangles.empty()) continue;
        out += "DEF " + names.unique(identifier(object.name, "object_")) + " Group { children [\n";
        if (!object.name.empty()) {
            out += "  WorldInfo { title ";
            append_quoted(out, object.name);
            out += " }\n";
        }
        out += "  Shape {\n";
        append_material(out, object.material);
        append_geometry(out, object, triangles, scene.unit.metres);
        out += "  }\n] }\n";
    }
    return out;
}

}  // namespace frep::encode
