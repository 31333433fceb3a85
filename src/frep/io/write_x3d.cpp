// X3D 3.3 (ISO/IEC 19775-1:2013, XML encoding ISO/IEC 19776-1), profile Interchange: a Group an object,
// metres, Y up. The names of objects stand as DEF, reduced to identifiers, and in full in a WorldInfo. See
// mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/write_web3d.h"

namespace frep::encode {

namespace {

constexpr std::string_view prolog =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<!DOCTYPE X3D PUBLIC \"ISO//Web3D//DTD X3D 3.3//EN\" "
    "\"http://www.web3d.org/specifications/x3d-3.3.dtd\">\n"
    "<X3D profile=\"Interchange\" version=\"3.3\" "
    "xmlns:xsd=\"http://www.w3.org/2001/XMLSchema-instance\" "
    "xsd:noNamespaceSchemaLocation=\"http://www.web3d.org/specifications/x3d-3.3.xsd\">\n";

void append_meta(std::string& out, std::string_view name, std::string_view text) {
    if (text.empty()) return;
    out += "  <meta name=\"";
    out += name;
    out += "\" content=\"";
    append_xml(out, text);
    out += "\"/>\n";
}

void append_world(std::string& out, std::string_view indent, std::string_view title) {
    if (title.empty()) return;
    out += indent;
    out += "<WorldInfo title=\"";
    append_xml(out, title);
    out += "\"/>\n";
}

void append_color(std::string& out, std::string_view attribute, const Color& color) {
    out.push_back(' ');
    out += attribute;
    out += "=\"";
    append_numbers<float>(out, {color.r, color.g, color.b});
    out.push_back('"');
}

void append_material(std::string& out, const Material& material) {
    const PhongMaterial phong = phong_material(material);
    out += "    <Appearance><Material";
    append_color(out, "diffuseColor", phong.diffuse);
    append_color(out, "specularColor", phong.specular);
    out += " shininess=\"";
    append_real(out, phong.shininess);
    out += "\"/></Appearance>\n";
}

void append_indices(std::string& out, const std::vector<Triangle>& triangles) {
    out += "    <IndexedFaceSet solid=\"false\" coordIndex=\"\n";
    for (const Triangle& t : triangles) {
        for (const std::uint32_t v : t) {
            append_number(out, v);
            out.push_back(' ');
        }
        out += "-1\n";
    }
    out += "\">\n";
}

/// The nodes Coordinate, Normal and Color: one line a vertex.
void append_vertices(std::string& out, const ObjectView& object, double metres) {
    const Mesh& mesh = *object.mesh;
    out += "     <Coordinate point=\"\n";
    for (const Vec3& v : mesh.vertices) {
        append_numbers<float>(out, y_up(v, metres));
        out.push_back('\n');
    }
    out += "\"/>\n";
    if (!mesh.normals.empty()) {
        out += "     <Normal vector=\"\n";
        for (const Vec3& n : unit_normals(mesh)) {
            append_numbers<float>(out, y_up(n, 1));
            out.push_back('\n');
        }
        out += "\"/>\n";
    }
    if (mesh.colors.empty()) return;
    out += "     <Color color=\"\n";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Color color = vertex_color(object, i);
        append_numbers<float>(out, {color.r, color.g, color.b});
        out.push_back('\n');
    }
    out += "\"/>\n";
}

}  // namespace

std::string write_x3d(const SceneView& scene) {
    std::string out(prolog);
    out += " <head>\n";
    append_meta(out, "title", scene.title);
    append_meta(out, "creator", scene.author);
    append_meta(out, "license", scene.license);
    append_meta(out, "reference", scene.source);
    append_meta(out, "generator", "frep");
    out += " </head>\n <Scene>\n";
    append_world(out, "  ", scene.title);
    UniqueNames names;
    for (const ObjectView& object : scene.objects) {
        const std::vector<Triangle> triangles = proper_triangles(object.mesh->triangles);
        if (triangles.empty()) continue;
        out += "  <Group DEF=\"" + names.unique(identifier(object.name, "object_")) + "\">\n";
        append_world(out, "   ", object.name);
        out += "   <Shape>\n";
        append_material(out, object.material);
        append_indices(out, triangles);
        append_vertices(out, object, scene.unit.metres);
        out += "    </IndexedFaceSet>\n   </Shape>\n  </Group>\n";
    }
    out += " </Scene>\n</X3D>\n";
    return out;
}

}  // namespace frep::encode
