// PLY 1.0, the Stanford polygon format: binary little endian or text, binary32, with normals where all
// objects have them and 8-bit colors where one has. See mesh_format.h.
#include "frep/io/encode.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

struct Layout {
    std::size_t vertices = 0, triangles = 0;
    bool normals = true, colors = false;
};

Layout layout_of(const SceneView& scene) {
    Layout layout;
    bool empty = true;
    for (const ObjectView& object : scene.objects) {
        const Mesh& mesh = *object.mesh;
        if (mesh.vertices.empty()) continue;
        empty = false;
        layout.vertices += mesh.vertices.size();
        layout.triangles += mesh.triangles.size();
        layout.normals = layout.normals && !mesh.normals.empty();
        layout.colors = layout.colors || !mesh.colors.empty();
    }
    layout.normals = layout.normals && !empty;
    return layout;
}

std::string header(const Layout& layout, bool ascii) {
    std::string out = ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
    out += "comment frep\nelement vertex ";
    append_number(out, layout.vertices);
    out += "\nproperty float x\nproperty float y\nproperty float z\n";
    if (layout.normals) out += "property float nx\nproperty float ny\nproperty float nz\n";
    if (layout.colors) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out += "element face ";
    append_number(out, layout.triangles);
    out += "\nproperty list uchar int vertex_indices\nend_header\n";
    return out;
}

/// A normal as it is, zero where it is not finite.
Vec3 written_normal(const Mesh& mesh, std::size_t i) {
    const Vec3& n = mesh.normals[i];
    return dot(n, n) <= 1e30 ? n : Vec3{0, 0, 0};
}

void append_text_vertices(std::string& out, const ObjectView& object, const Layout& layout) {
    const Mesh& mesh = *object.mesh;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        append_numbers<float>(out, mesh.vertices[i]);
        if (layout.normals) {
            out.push_back(' ');
            append_numbers<float>(out, written_normal(mesh, i));
        }
        if (layout.colors) {
            const std::uint32_t color = color_bits(vertex_color(object, i));
            for (int shift = 16; shift >= 0; shift -= 8) {
                out.push_back(' ');
                append_number(out, (color >> shift) & 255u);
            }
        }
        out.push_back('\n');
    }
}

void append_binary_vertices(std::string& out, const ObjectView& object, const Layout& layout) {
    const Mesh& mesh = *object.mesh;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        append_vector(out, mesh.vertices[i]);
        if (layout.normals) append_vector(out, written_normal(mesh, i));
        if (layout.colors) {
            const std::uint32_t color = color_bits(vertex_color(object, i));
            for (int shift = 16; shift >= 0; shift -= 8) append_little_endian(out, color >> shift, 1);
        }
    }
}

void append_text_face(std::string& out, const Triangle& t, std::uint32_t first) {
    out.push_back('3');
    for (const std::uint32_t v : t) {
        out.push_back(' ');
        append_number(out, v + first);
    }
    out.push_back('\n');
}

void append_binary_face(std::string& out, const Triangle& t, std::uint32_t first) {
    out.push_back(3);
    for (const std::uint32_t v : t) append_little_endian(out, v + first);
}

}  // namespace

std::string write_ply(const SceneView& scene, bool ascii) {
    const Layout layout = layout_of(scene);
    std::string out = header(layout, ascii);
    if (!ascii) {
        const std::size_t vertex_bytes = 12 + (layout.normals ? 12u : 0u) + (layout.colors ? 3u : 0u);
        out.reserve(out.size() + vertex_bytes * layout.vertices + 13 * layout.triangles);
    }
    for (const ObjectView& object : scene.objects) {
        if (ascii) {
            append_text_vertices(out, object, layout);
        } else {
            append_binary_vertices(out, object, layout);
        }
    }
    std::uint32_t first = 0;
    for (const ObjectView& object : scene.objects) {
        for (const Triangle& t : object.mesh->triangles) {
            if (ascii) {
                append_text_face(out, t, first);
            } else {
                append_binary_face(out, t, first);
            }
        }
        first += static_cast<std::uint32_t>(object.mesh->vertices.size());
    }
    return out;
}

}  // namespace frep::encode
