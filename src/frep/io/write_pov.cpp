// POV-Ray 3.7 scene description: a mesh2 an object, declared under its name, and a small scene around them
// that is left out when the file is included after `#declare Frep_Include = 1;`. POV-Ray's space is
// left-handed with Y up, so Y and Z change places; lengths are in model units. Colors are in linear light,
// for scenes with assumed_gamma 1. A closed mesh has an inside_vector and can stand in a difference. Rendered
// by tests/validators where povray is installed.
#include <algorithm>

#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

Vec3 y_and_z_swapped(const Vec3& p) { return {p.x, p.z, p.y}; }

void append_triple(std::string& out, const Vec3& v) {
    out.push_back('<');
    append_numbers<float>(out, v, ",");
    out.push_back('>');
}

void append_comment(std::string& out, std::string_view key, std::string_view text) {
    if (text.empty()) return;
    out += "// ";
    out += key;
    out += ": ";
    out += clean_text(text);
    out.push_back('\n');
}

/// `  KEY { COUNT` and a vector on each line.
void append_vectors(std::string& out, std::string_view key, const std::vector<Vec3>& vectors) {
    out += " ";
    out += key;
    out += " {\n  ";
    append_number(out, vectors.size());
    for (const Vec3& v : vectors) {
        out += ",\n  ";
        append_triple(out, y_and_z_swapped(v));
    }
    out += "\n }\n";
}

/// An approximation of the metallic-roughness model by POV-Ray's highlights and reflection.
void append_finish(std::string& out, const Material& m, const std::string& name) {
    const double smooth = 1 - m.roughness;
    out += "#declare " + name + " = finish {\n diffuse ";
    append_real(out, 0.9 - 0.5 * m.metallic);
    out += " specular ";
    append_real(out, 0.5 * std::max(smooth, m.clearcoat));
    out += " roughness ";
    append_real(out, std::max(0.002, 0.3 * m.roughness * m.roughness * (1 - 0.8 * m.clearcoat)));
    out += " metallic ";
    append_real(out, m.metallic);
    out += "\n reflection { ";
    append_real(out, 0.5 * m.metallic * smooth);
    out += ", ";
    append_real(out, std::max(0.6 * m.metallic * smooth, 0.3 * m.clearcoat));
    out += " falloff 3 }\n}\n";
}

/// The color in linear light, for scenes with assumed_gamma 1.
void append_texture(std::string& out, const Color& color, const std::string& finish) {
    const Color linear = linear_from_srgb(color);
    out += "texture { pigment { color rgb ";
    append_triple(out, {linear.r, linear.g, linear.b});
    out += " } finish { " + finish + " } }\n";
}

void append_palette(std::string& out, const Palette& palette, const std::string& finish) {
    out += " texture_list {\n  ";
    append_number(out, palette.colors.size());
    out += ",\n";
    for (const std::uint32_t color : palette.colors) {
        const auto component = [color](int shift) { return double((color >> shift) & 255u) / 255; };
        out += "  ";
        append_texture(out, {component(16), component(8), component(0)}, finish);
    }
    out += " }\n";
}

void append_faces(std::string& out, const std::vector<Triangle>& triangles,
                  const std::vector<std::uint32_t>& color) {
    out += " face_indices {\n  ";
    append_number(out, triangles.size());
    for (const Triangle& t : triangles) {
        out += ",\n  <";
        for (std::size_t k = 0; k < 3; ++k) {
            if (k > 0) out.push_back(',');
            append_number(out, t[k]);
        }
        out.push_back('>');
        for (std::size_t k = 0; k < 3 && !color.empty(); ++k) {
            out.push_back(',');
            append_number(out, color[t[k]]);
        }
    }
    out += "\n }\n";
}

void append_object(std::string& out, const ObjectView& object, const std::vector<Triangle>& triangles,
                   const std::string& name, const std::string& finish) {
    const Mesh& mesh = *object.mesh;
    append_comment(out, "object", object.name);
    append_finish(out, object.material, finish);
    out += "#declare " + name + " = mesh2 {\n";
    append_vectors(out, "vertex_vectors", mesh.vertices);
    if (!mesh.normals.empty()) append_vectors(out, "normal_vectors", unit_normals(mesh));
    std::vector<std::uint32_t> color;
    if (!mesh.colors.empty()) {
        const Palette palette = palette_of(object);
        color.reserve(mesh.vertices.size());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            color.push_back(palette.index(color_bits(vertex_color(object, i))));
        }
        append_palette(out, palette, finish);
    }
    append_faces(out, triangles, color);
    if (is_closed(triangles)) out += " inside_vector <0, 1, 0>\n";
    if (mesh.colors.empty()) {
        out.push_back(' ');
        append_texture(out, object.material.base, finish);
    }
    out += "}\n";
}

/// A camera that sees the whole, two lights and a background, in POV-Ray's space.
void append_stage(std::string& out, const Box3& box) {
    const Vec3 center = y_and_z_swapped(0.5 * (box.min + box.max));
    const double radius = box.diagonal() > 0 ? 0.5 * box.diagonal() : 1;
    const auto at = [&](const Vec3& direction) { append_triple(out, center + direction * radius); };
    out +=
        " global_settings { assumed_gamma 1 }\n background { color rgb 0.8 }\n"
        " camera {\n  location ";
    at({1.2, 1.1, -3});
    out += "\n  look_at ";
    at({0, 0, 0});
    out += "\n  angle 48\n }\n light_source { ";
    at({-4, 8, -6});
    out += " color rgb 1 }\n light_source { ";
    at({8, 2, -3});
    out += " color rgb 0.3 shadowless }\n";
}

void grow(Box3& box, const Mesh& mesh, bool& first) {
    for (const Vec3& v : mesh.vertices) {
        if (first) box = {v, v};
        first = false;
        box.min = {std::min(box.min.x, v.x), std::min(box.min.y, v.y), std::min(box.min.z, v.z)};
        box.max = {std::max(box.max.x, v.x), std::max(box.max.y, v.y), std::max(box.max.z, v.z)};
    }
}

}  // namespace

std::string write_pov(const SceneView& scene) {
    std::string out = "// frep: for POV-Ray 3.7 and later\n";
    append_comment(out, "title", scene.title);
    append_comment(out, "author", scene.author);
    append_comment(out, "license", scene.license);
    append_comment(out, "source", scene.source);
    out += "// Lengths in " + std::string(scene.unit.name) +
           ". To use the objects in another scene: #declare Frep_Include = 1; #include \"this file\"\n"
           "#version 3.7;\n";
    UniqueNames names;
    std::vector<std::string> declared;
    Box3 box{{0, 0, 0}, {0, 0, 0}};
    bool first = true;
    for (const ObjectView& object : scene.objects) {
        const std::vector<Triangle> triangles = proper_triangles(object.mesh->triangles);
        if (triangles.empty()) continue;
        declared.push_back(names.unique("Frep_" + identifier(object.name, "Object")));
        append_object(out, object, triangles, declared.back(), names.unique(declared.back() + "_Finish"));
        grow(box, *object.mesh, first);
    }
    out += "#ifndef (Frep_Include)\n";
    for (const std::string& name : declared) out += " object { " + name + " }\n";
    append_stage(out, box);
    out += "#end\n";
    return out;
}

}  // namespace frep::encode
