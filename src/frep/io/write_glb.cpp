// GLB, the binary form of glTF 2.0 (Khronos, ISO/IEC 12113:2022), with KHR_materials_clearcoat: metres, Y up,
// (x, y, z) -> (x, z, -y). Numbers in brackets are sections of the specification. Colors of vertices are
// linear, 16 bits a component with an alpha of 1, so that an element has a multiple of 4 bytes (3.6.2.4).
// Judged by the Khronos validator in tests/validators.
#include <algorithm>

#include "frep/io/encode.h"
#include "frep/io/text.h"
#include "frep/io/writers.h"

namespace frep::encode {

namespace {

constexpr std::uint32_t unused = 0xffffffffu;

/// The part of a mesh that is written: vertices that a triangle names, no triangle twice at one vertex.
struct Part {
    const ObjectView* object = nullptr;
    std::vector<std::uint32_t> vertices;  ///< numbers in the mesh
    std::vector<Triangle> triangles;      ///< of positions in `vertices`
    Vec3 low, high;                       ///< of the binary32 coordinates as written
    std::uint64_t indices_at = 0, positions_at = 0, normals_at = 0, colors_at = 0;
};

/// A point in metres with Y up, as written.
Vec3 placed(const Vec3& p, double metres) {
    const auto written = [](double value) { return rounded_to_binary32(value) + 0.0; };
    return {written(p.x * metres), written(p.z * metres), written(-p.y * metres)};
}

void extend(Part& part, const Vec3& p, bool first) {
    const auto less = [first](double a, double b) { return first || a < b; };
    part.low = {less(p.x, part.low.x) ? p.x : part.low.x, less(p.y, part.low.y) ? p.y : part.low.y,
                less(p.z, part.low.z) ? p.z : part.low.z};
    part.high = {less(-p.x, -part.high.x) ? p.x : part.high.x, less(-p.y, -part.high.y) ? p.y : part.high.y,
                 less(-p.z, -part.high.z) ? p.z : part.high.z};
}

Part part_of(const ObjectView& object, double metres) {
    Part part;
    part.object = &object;
    part.triangles = proper_triangles(object.mesh->triangles);
    std::vector<std::uint32_t> place(object.mesh->vertices.size(), unused);
    for (const Triangle& t : part.triangles) {
        for (const std::uint32_t v : t) place[v] = 0;
    }
    for (std::uint32_t v = 0; v < place.size(); ++v) {
        if (place[v] == unused) continue;
        place[v] = static_cast<std::uint32_t>(part.vertices.size());
        extend(part, placed(object.mesh->vertices[v], metres), part.vertices.empty());
        part.vertices.push_back(v);
    }
    for (Triangle& t : part.triangles) t = {place[t[0]], place[t[1]], place[t[2]]};
    return part;
}

/// Lays the parts out in the buffer; returns its length.
std::uint64_t lay_out(std::vector<Part>& parts) {
    std::uint64_t at = 0;
    const auto take = [&at](std::uint64_t bytes) { return (at += bytes) - bytes; };
    for (Part& part : parts) {
        part.indices_at = take(12 * std::uint64_t{part.triangles.size()});
        part.positions_at = take(12 * std::uint64_t{part.vertices.size()});
        if (!part.object->mesh->normals.empty()) part.normals_at = take(12 * part.vertices.size());
        if (!part.object->mesh->colors.empty()) part.colors_at = take(8 * part.vertices.size());
    }
    return at;
}

// --- JSON

void append_key(std::string& out, std::string_view key) {
    if (out.back() != '{' && out.back() != '[') out.push_back(',');
    out.push_back('"');
    out += key;
    out += "\":";
}

void append_text(std::string& out, std::string_view key, std::string_view text) {
    if (text.empty()) return;
    append_key(out, key);
    append_quoted(out, text);
}

template <class Number>
void append_member(std::string& out, std::string_view key, Number value) {
    append_key(out, key);
    append_number(out, value);
}

void append_triple(std::string& out, std::string_view key, const Vec3& v) {
    append_key(out, key);
    out.push_back('[');
    append_numbers<double>(out, v, ",");
    out.push_back(']');
}

void append_separator(std::string& out) {
    if (out.back() != '[') out.push_back(',');
}

void append_asset(std::string& out, const SceneView& scene) {
    append_key(out, "asset");
    out += R"({"version":"2.0","generator":"frep")";
    const std::string between = scene.author.empty() || scene.license.empty() ? "" : ", ";
    append_text(out, "copyright", std::string(scene.author) + between + std::string(scene.license));
    if (!(scene.title.empty() && scene.author.empty() && scene.license.empty() && scene.source.empty())) {
        append_key(out, "extras");
        out.push_back('{');
        append_text(out, "title", scene.title);
        append_text(out, "author", scene.author);
        append_text(out, "license", scene.license);
        append_text(out, "source", scene.source);
        out.push_back('}');
    }
    out.push_back('}');
}

/// The scene, a node for each part; parts and nodes have the same numbers.
void append_nodes(std::string& out, const SceneView& scene, const std::vector<Part>& parts) {
    append_member(out, "scene", 0);
    append_key(out, "scenes");
    out += "[{";
    append_text(out, "name", scene.title);
    if (!parts.empty()) {
        append_key(out, "nodes");
        out.push_back('[');
        for (std::size_t i = 0; i < parts.size(); ++i) {
            append_separator(out);
            append_number(out, i);
        }
        out.push_back(']');
    }
    out += "}]";
    if (parts.empty()) return;
    append_key(out, "nodes");
    out.push_back('[');
    for (std::size_t i = 0; i < parts.size(); ++i) {
        append_separator(out);
        out.push_back('{');
        append_text(out, "name", parts[i].object->name);
        append_member(out, "mesh", i);
        out.push_back('}');
    }
    out.push_back(']');
}

double share(double value) { return !(value > 0) ? 0 : value > 1 ? 1 : value; }

void append_materials(std::string& out, const std::vector<Part>& parts) {
    append_key(out, "materials");
    out.push_back('[');
    for (const Part& part : parts) {
        const Material& m = part.object->material;
        append_separator(out);
        out.push_back('{');
        append_text(out, "name", part.object->name);
        append_key(out, "pbrMetallicRoughness");
        out.push_back('{');
        const Color base = linear_from_srgb(m.base);
        append_key(out, "baseColorFactor");
        out.push_back('[');
        append_numbers<float>(out, {base.r, base.g, base.b}, ",");
        out += ",1]";
        append_member(out, "metallicFactor", static_cast<float>(share(m.metallic)));
        append_member(out, "roughnessFactor", static_cast<float>(share(m.roughness)));
        out.push_back('}');
        if (m.clearcoat > 0) {
            append_key(out, "extensions");
            out += R"({"KHR_materials_clearcoat":{"clearcoatFactor":)";
            append_number(out, static_cast<float>(share(m.clearcoat)));
            out += R"(,"clearcoatRoughnessFactor":0.03}})";
        }
        out += R"(,"doubleSided":true})";
    }
    out.push_back(']');
}

/// An accessor of the next buffer view; both have the same numbers, counted in `views`.
void append_accessor(std::string& out, std::size_t& views, std::uint64_t count, std::string_view rest) {
    append_separator(out);
    out.push_back('{');
    append_member(out, "bufferView", views++);
    append_member(out, "count", count);
    out += rest;
}

void append_accessors(std::string& out, const std::vector<Part>& parts) {
    append_key(out, "accessors");
    out.push_back('[');
    std::size_t views = 0;
    for (const Part& part : parts) {
        const Mesh& mesh = *part.object->mesh;
        const std::size_t n = part.vertices.size();
        append_accessor(out, views, 3 * part.triangles.size(), R"(,"componentType":5125,"type":"SCALAR"})");
        append_accessor(out, views, n, R"(,"componentType":5126,"type":"VEC3")");
        append_triple(out, "min", part.low);
        append_triple(out, "max", part.high);
        out.push_back('}');
        if (!mesh.normals.empty()) append_accessor(out, views, n, R"(,"componentType":5126,"type":"VEC3"})");
        if (!mesh.colors.empty()) {
            append_accessor(out, views, n, R"(,"componentType":5123,"normalized":true,"type":"VEC4"})");
        }
    }
    out.push_back(']');
}

void append_meshes(std::string& out, const std::vector<Part>& parts) {
    append_key(out, "meshes");
    out.push_back('[');
    std::size_t accessor = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Mesh& mesh = *parts[i].object->mesh;
        append_separator(out);
        out.push_back('{');
        append_text(out, "name", parts[i].object->name);
        append_key(out, "primitives");
        out += "[{";
        append_member(out, "indices", accessor++);
        append_member(out, "material", i);
        append_key(out, "attributes");
        out.push_back('{');
        append_member(out, "POSITION", accessor++);
        if (!mesh.normals.empty()) append_member(out, "NORMAL", accessor++);
        if (!mesh.colors.empty()) append_member(out, "COLOR_0", accessor++);
        out += "}}]}";
    }
    out.push_back(']');
}

void append_view(std::string& out, std::uint64_t at, std::uint64_t bytes, int target) {
    append_separator(out);
    out.push_back('{');
    append_member(out, "buffer", 0);
    append_member(out, "byteOffset", at);
    append_member(out, "byteLength", bytes);
    append_member(out, "target", target);
    out.push_back('}');
}

void append_buffers(std::string& out, const std::vector<Part>& parts, std::uint64_t bytes) {
    constexpr int vertices = 34962, indices = 34963;
    append_key(out, "bufferViews");
    out.push_back('[');
    for (const Part& part : parts) {
        const std::uint64_t n = part.vertices.size();
        append_view(out, part.indices_at, 12 * std::uint64_t{part.triangles.size()}, indices);
        append_view(out, part.positions_at, 12 * n, vertices);
        if (!part.object->mesh->normals.empty()) append_view(out, part.normals_at, 12 * n, vertices);
        if (!part.object->mesh->colors.empty()) append_view(out, part.colors_at, 8 * n, vertices);
    }
    out += "]";
    append_key(out, "buffers");
    out += "[{";
    append_member(out, "byteLength", bytes);
    out += "}]";
}

std::string json_of(const SceneView& scene, const std::vector<Part>& parts, std::uint64_t bytes) {
    std::string out = "{";
    append_asset(out, scene);
    const bool coated = std::any_of(parts.begin(), parts.end(),
                                    [](const Part& p) { return p.object->material.clearcoat > 0; });
    if (coated) {
        append_key(out, "extensionsUsed");
        out += R"(["KHR_materials_clearcoat"])";
    }
    append_nodes(out, scene, parts);
    if (!parts.empty()) {
        append_meshes(out, parts);
        append_materials(out, parts);
        append_accessors(out, parts);
        append_buffers(out, parts, bytes);
    }
    out.push_back('}');
    while (out.size() % 4 != 0) out.push_back(' ');  // 4.4.3.2
    return out;
}

// --- the binary chunk

void append_part(std::string& out, const Part& part, double metres) {
    const Mesh& mesh = *part.object->mesh;
    for (const Triangle& t : part.triangles) {
        for (const std::uint32_t v : t) append_little_endian(out, v);
    }
    for (const std::uint32_t v : part.vertices) append_vector(out, placed(mesh.vertices[v], metres));
    if (!mesh.normals.empty()) {
        const std::vector<Vec3> normals = unit_normals(mesh);
        for (const std::uint32_t v : part.vertices) append_vector(out, placed(normals[v], 1));
    }
    if (mesh.colors.empty()) return;
    for (const std::uint32_t v : part.vertices) {
        const Color color = linear_from_srgb(mesh.colors[v]);
        for (const double c : {color.r, color.g, color.b, 1.0}) {
            append_little_endian(out, static_cast<std::uint32_t>(c * 65535 + 0.5), 2);
        }
    }
}

void append_chunk_head(std::string& out, std::uint64_t bytes, std::string_view type) {
    append_little_endian(out, static_cast<std::uint32_t>(bytes));
    out += type;
}

}  // namespace

Result<std::string> write_glb(const SceneView& scene) {
    std::vector<Part> parts;
    for (const ObjectView& object : scene.objects) {
        Part part = part_of(object, scene.unit.metres);
        if (!part.triangles.empty()) parts.push_back(std::move(part));
    }
    const std::uint64_t bytes = lay_out(parts);
    const std::string json = json_of(scene, parts, bytes);
    const std::uint64_t total = 12 + 8 + json.size() + (parts.empty() ? 0 : 8 + bytes);
    if (total > 0xffffffffu) {
        return Error{ErrorKind::over_limit, "the mesh needs more than the 4 GiB that a GLB file can have"};
    }
    std::string out;
    out.reserve(total);
    out += "glTF";
    append_little_endian(out, 2);
    append_little_endian(out, static_cast<std::uint32_t>(total));
    append_chunk_head(out, json.size(), "JSON");
    out += json;
    if (!parts.empty()) {
        append_chunk_head(out, bytes, std::string_view("BIN\0", 4));
        for (const Part& part : parts) append_part(out, part, scene.unit.metres);
    }
    return out;
}

}  // namespace frep::encode
