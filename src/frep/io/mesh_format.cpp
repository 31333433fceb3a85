// Encoders of the mesh formats; see mesh_format.h for the formats and their test.
#include "frep/io/mesh_format.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>

#include "frep/base/source.h"
#include "frep/io/encode.h"

namespace frep {

namespace {

using encode::append_float;
using encode::append_little_endian;
using encode::append_number;

bool fits(double value, double limit) { return value >= -limit && value <= limit; }

/// Nothing, or why a vertex cannot be written.
Status check_coordinates(const Mesh& mesh, MeshFormat format) {
    const double limit = format == MeshFormat::off ? std::numeric_limits<double>::max()
                                                   : double{std::numeric_limits<float>::max()};
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& v = mesh.vertices[i];
        if (fits(v.x, limit) && fits(v.y, limit) && fits(v.z, limit)) continue;
        return Error{ErrorKind::invalid_argument,
                     fmt::format("vertex {} has a coordinate that the file format cannot hold", i)};
    }
    return {};
}

Status check_counts(const Mesh& mesh, MeshFormat format) {
    const std::size_t triangle_limit = format == MeshFormat::stl ? 0xffffffffu : 0x7fffffffu;
    if (mesh.vertices.size() <= 0x7fffffffu && mesh.triangles.size() <= triangle_limit) return {};
    return Error{ErrorKind::over_limit, "the mesh has more elements than the file format can count"};
}

void append_vector(std::string& out, Vec3 v) {
    append_float(out, v.x);
    append_float(out, v.y);
    append_float(out, v.z);
}

/// Three numbers as text, separated by blanks; binary32 if Number is float. Zeros without sign.
template <class Number>
void append_numbers(std::string& out, Vec3 v) {
    append_number(out, static_cast<Number>(v.x) + Number{0});
    out.push_back(' ');
    append_number(out, static_cast<Number>(v.y) + Number{0});
    out.push_back(' ');
    append_number(out, static_cast<Number>(v.z) + Number{0});
}

void append_indices(std::string& out, const Triangle& t) {
    out.push_back('3');
    for (const std::uint32_t v : t) {
        out.push_back(' ');
        append_number(out, v);
    }
    out.push_back('\n');
}

std::string encode_off(const Mesh& mesh) {
    std::string out = "OFF\n";
    append_number(out, mesh.vertices.size());
    out.push_back(' ');
    append_number(out, mesh.triangles.size());
    out += " 0\n";
    for (const Vec3& v : mesh.vertices) {
        append_numbers<double>(out, v);
        out.push_back('\n');
    }
    for (const Triangle& t : mesh.triangles) append_indices(out, t);
    return out;
}

std::string ply_header(const Mesh& mesh, bool ascii) {
    std::string out = ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
    out += "comment frep\nelement vertex ";
    append_number(out, mesh.vertices.size());
    out += "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!mesh.normals.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
    out += "element face ";
    append_number(out, mesh.triangles.size());
    out += "\nproperty list uchar int vertex_indices\nend_header\n";
    return out;
}

std::string encode_ply_text(const Mesh& mesh) {
    std::string out = ply_header(mesh, true);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        append_numbers<float>(out, mesh.vertices[i]);
        if (!mesh.normals.empty()) {
            out.push_back(' ');
            append_numbers<float>(out, mesh.normals[i]);
        }
        out.push_back('\n');
    }
    for (const Triangle& t : mesh.triangles) append_indices(out, t);
    return out;
}

std::string encode_ply_binary(const Mesh& mesh) {
    std::string out = ply_header(mesh, false);
    const std::size_t vertex_bytes = mesh.normals.empty() ? 12 : 24;
    out.reserve(out.size() + vertex_bytes * mesh.vertices.size() + 13 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        append_vector(out, mesh.vertices[i]);
        if (!mesh.normals.empty()) append_vector(out, mesh.normals[i]);
    }
    for (const Triangle& t : mesh.triangles) {
        out.push_back(3);
        for (const std::uint32_t v : t) append_little_endian(out, v);
    }
    return out;
}

/// The unit normal of a triangle by the right-hand rule; zero for a degenerate one.
Vec3 facet_normal(const Mesh& mesh, const Triangle& t) {
    const Vec3 a = mesh.vertices[t[0]];
    const Vec3 n = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    const double size = length(n);
    return size > 0 && size <= std::numeric_limits<double>::max() ? n / size : Vec3{0, 0, 0};
}

std::string encode_stl_text(const Mesh& mesh) {
    std::string out = "solid frep\n";
    for (const Triangle& t : mesh.triangles) {
        out += "facet normal ";
        append_numbers<float>(out, facet_normal(mesh, t));
        out += "\n outer loop\n";
        for (const std::uint32_t v : t) {
            out += "  vertex ";
            append_numbers<float>(out, mesh.vertices[v]);
            out.push_back('\n');
        }
        out += " endloop\nendfacet\n";
    }
    out += "endsolid frep\n";
    return out;
}

std::string encode_stl_binary(const Mesh& mesh) {
    std::string out = "frep: binary STL, little endian, lengths in model units";
    out.resize(80, ' ');
    out.reserve(84 + 50 * mesh.triangles.size());
    append_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
        append_vector(out, facet_normal(mesh, t));
        for (const std::uint32_t v : t) append_vector(out, mesh.vertices[v]);
        append_little_endian(out, 0, 2);  // attribute byte count
    }
    return out;
}

struct Extension {
    std::string_view name;
    MeshFormat format;
};
constexpr std::array extensions{Extension{".off", MeshFormat::off}, Extension{".ply", MeshFormat::ply},
                                Extension{".stl", MeshFormat::stl}, Extension{".obj", MeshFormat::obj},
                                Extension{".glb", MeshFormat::glb}, Extension{".wrl", MeshFormat::vrml},
                                Extension{".x3d", MeshFormat::x3d}, Extension{".3mf", MeshFormat::threemf},
                                Extension{".pov", MeshFormat::pov}};

}  // namespace

Result<MeshFormat> mesh_format_from_path(std::string_view path) {
    const std::size_t slash = path.find_last_of('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const std::size_t dot = name.find_last_of('.');
    const std::string extension = lower_case(dot == std::string_view::npos ? "" : name.substr(dot));
    for (const Extension& known : extensions) {
        if (extension == known.name) return known.format;
    }
    std::string message = fmt::format("'{}' has no extension of a known mesh format; known are", path);
    for (const Extension& known : extensions) message += fmt::format(" {}", known.name);
    return Error{ErrorKind::invalid_argument, message};
}

Result<std::string> encode_mesh(const Mesh& mesh, MeshFormat format, const MeshEncodeOptions& options) {
    if (!is_valid(mesh)) {
        return Error{ErrorKind::invalid_argument, "the mesh has an index that names no vertex"};
    }
    if (Status ok = check_counts(mesh, format); !ok) return ok.error();
    if (Status ok = check_coordinates(mesh, format); !ok) return ok.error();
    switch (format) {
        case MeshFormat::off:
            return encode_off(mesh);
        case MeshFormat::ply:
            return options.ascii ? encode_ply_text(mesh) : encode_ply_binary(mesh);
        case MeshFormat::stl:
            return options.ascii ? encode_stl_text(mesh) : encode_stl_binary(mesh);
        default:
            break;
    }
    return Error{ErrorKind::invalid_argument, "this format is not written yet"};
}

Result<EncodedFiles> encode_scene(const Scene& scene, MeshFormat format, const MeshEncodeOptions& options) {
    auto bytes = encode_mesh(merged(scene), format, options);
    if (!bytes) return bytes.error();
    return EncodedFiles{std::move(*bytes), {}};
}

}  // namespace frep
