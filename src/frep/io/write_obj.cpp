// Wavefront OBJ and its material library MTL (Wavefront Technologies, Advanced Visualizer manual, appendix
// B1, with the common extensions: colors behind the coordinates of a vertex, Pr Pm Pc of physically based
// materials). Model units, Z up. See mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

void append_comment(std::string& out, std::string_view key, std::string_view text) {
    if (text.empty()) return;
    out += "# ";
    out += key;
    out += ": ";
    out += clean_text(text);
    out.push_back('\n');
}

std::string heading(const SceneView& scene) {
    std::string out = "# frep\n";
    append_comment(out, "title", scene.title);
    append_comment(out, "author", scene.author);
    append_comment(out, "license", scene.license);
    append_comment(out, "source", scene.source);
    return out;
}

void append_color(std::string& out, std::string_view key, const Color& color) {
    out += key;
    out.push_back(' ');
    append_numbers<float>(out, {color.r, color.g, color.b});
    out.push_back('\n');
}

void append_value(std::string& out, std::string_view key, double value) {
    out += key;
    out.push_back(' ');
    append_real(out, value);
    out.push_back('\n');
}

/// Phong's numbers are an approximation of the metallic-roughness model; Pr, Pm and Pc are the model itself.
void append_material(std::string& out, const ObjectView& object, const std::string& name) {
    const Material& m = object.material;
    const Color diffuse = object.mesh->colors.empty() ? m.base : Color{1, 1, 1};
    const double gray = 0.5 * (1 - m.roughness) * (1 - m.metallic);
    out += "newmtl " + name + '\n';
    append_color(out, "Ka", {0, 0, 0});
    append_color(out, "Kd", diffuse);
    append_color(
        out, "Ks",
        {gray + m.metallic * diffuse.r, gray + m.metallic * diffuse.g, gray + m.metallic * diffuse.b});
    const double smooth = 1 - m.roughness;
    append_value(out, "Ns", 1000 * smooth * smooth);
    append_value(out, "d", 1);
    out += "illum 2\n";
    append_value(out, "Pr", m.roughness);
    append_value(out, "Pm", m.metallic);
    if (m.clearcoat > 0) append_value(out, "Pc", m.clearcoat);
}

void append_vertices(std::string& out, const ObjectView& object) {
    const Mesh& mesh = *object.mesh;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        out += "v ";
        append_numbers<float>(out, mesh.vertices[i]);
        if (!mesh.colors.empty()) {
            const Color color = vertex_color(object, i);
            out.push_back(' ');
            append_numbers<float>(out, {color.r, color.g, color.b});
        }
        out.push_back('\n');
    }
    for (const Vec3& n : unit_normals(mesh)) {
        out += "vn ";
        append_numbers<float>(out, n);
        out.push_back('\n');
    }
}

/// Faces with global numbers from 1; `first` and `first_normal` are the numbers before the object's own.
void append_faces(std::string& out, const Mesh& mesh, std::size_t first, std::size_t first_normal) {
    for (const Triangle& t : mesh.triangles) {
        out.push_back('f');
        for (const std::uint32_t v : t) {
            out.push_back(' ');
            append_number(out, v + first + 1);
            if (mesh.normals.empty()) continue;
            out += "//";
            append_number(out, v + first_normal + 1);
        }
        out.push_back('\n');
    }
}

}  // namespace

EncodedFiles write_obj(const SceneView& scene, std::string_view stem) {
    EncodedFiles files;
    const bool with_library = !stem.empty();
    const std::string library_name = word(stem, "frep") + ".mtl";
    std::string& out = files.bytes;
    out = heading(scene);
    std::string library = heading(scene);
    if (with_library) out += "mtllib " + library_name + '\n';
    UniqueNames names;
    std::size_t first = 0, first_normal = 0;
    for (const ObjectView& object : scene.objects) {
        const std::string name = names.unique(word(object.name, "object"));
        out += "o " + name + '\n';
        append_vertices(out, object);
        if (with_library) {
            out += "usemtl " + name + '\n';
            append_material(library, object, name);
        }
        append_faces(out, *object.mesh, first, first_normal);
        first += object.mesh->vertices.size();
        first_normal += object.mesh->normals.size();
    }
    if (with_library) files.side_files.push_back({library_name, std::move(library)});
    return files;
}

}  // namespace frep::encode
