// Which mesh formats there are and what each can hold; the writers are in write_*.cpp. See mesh_format.h for
// the formats and their tests.
#include "frep/io/mesh_format.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>

#include "frep/base/source.h"
#include "frep/io/writers.h"

namespace frep {

namespace {

using encode::ObjectView;
using encode::SceneView;

struct Extension {
    std::string_view name;
    MeshFormat format;
};
constexpr std::array extensions{Extension{".off", MeshFormat::off}, Extension{".ply", MeshFormat::ply},
                                Extension{".stl", MeshFormat::stl}, Extension{".obj", MeshFormat::obj},
                                Extension{".glb", MeshFormat::glb}, Extension{".wrl", MeshFormat::vrml},
                                Extension{".x3d", MeshFormat::x3d}, Extension{".3mf", MeshFormat::threemf},
                                Extension{".pov", MeshFormat::pov}};

bool is_in_metres(MeshFormat format) {
    return format == MeshFormat::glb || format == MeshFormat::vrml || format == MeshFormat::x3d;
}

/// The largest coordinate in model units that the format can hold.
double coordinate_limit(const SceneView& scene, MeshFormat format) {
    constexpr double binary32 = std::numeric_limits<float>::max();
    if (format == MeshFormat::off) return std::numeric_limits<double>::max();
    const double scale = is_in_metres(format)            ? scene.unit.metres
                         : format == MeshFormat::threemf ? encode::scale_3mf(scene.unit).factor
                                                         : 1;
    return scale > 1 ? binary32 / scale : binary32;
}

bool fits(double value, double limit) { return value >= -limit && value <= limit; }

/// Nothing, or why a vertex cannot be written.
Status check_coordinates(const SceneView& scene, MeshFormat format) {
    const double limit = coordinate_limit(scene, format);
    for (const ObjectView& object : scene.objects) {
        for (std::size_t i = 0; i < object.mesh->vertices.size(); ++i) {
            const Vec3& v = object.mesh->vertices[i];
            if (fits(v.x, limit) && fits(v.y, limit) && fits(v.z, limit)) continue;
            return Error{ErrorKind::invalid_argument,
                         fmt::format("vertex {} has a coordinate that the file format cannot hold", i)};
        }
    }
    return {};
}

Status check_counts(const SceneView& scene, MeshFormat format) {
    const std::size_t triangle_limit = format == MeshFormat::stl ? 0xffffffffu : 0x7fffffffu;
    std::size_t vertices = 0, triangles = 0;
    for (const ObjectView& object : scene.objects) {
        vertices += object.mesh->vertices.size();
        triangles += object.mesh->triangles.size();
    }
    if (vertices <= 0x7fffffffu && triangles <= triangle_limit) return {};
    return Error{ErrorKind::over_limit, "the mesh has more elements than the file format can count"};
}

Status check_scene(const SceneView& scene, MeshFormat format) {
    if (!(scene.unit.metres > 0 && scene.unit.metres <= 1e12)) {
        return Error{ErrorKind::invalid_argument, "the length of the unit is not positive and finite"};
    }
    for (const ObjectView& object : scene.objects) {
        if (is_valid(*object.mesh)) continue;
        return Error{ErrorKind::invalid_argument, "the mesh has an index that names no vertex"};
    }
    if (Status ok = check_counts(scene, format); !ok) return ok;
    return check_coordinates(scene, format);
}

/// A component of a material or a color inside 0..1; 0 for NaN.
double share(double value) { return !(value > 0) ? 0 : value > 1 ? 1 : value; }

Material in_range(const Material& m) {
    return {{share(m.base.r), share(m.base.g), share(m.base.b)},
            share(m.metallic),
            share(m.roughness),
            share(m.clearcoat)};
}

Result<EncodedFiles> only_file(Result<std::string> bytes) {
    if (!bytes) return bytes.error();
    return EncodedFiles{std::move(*bytes), {}};
}

Result<EncodedFiles> encode_view(const SceneView& scene, MeshFormat format,
                                 const MeshEncodeOptions& options) {
    if (Status ok = check_scene(scene, format); !ok) return ok.error();
    switch (format) {
        case MeshFormat::off:
            return only_file(encode::write_off(scene));
        case MeshFormat::ply:
            return only_file(encode::write_ply(scene, options.ascii));
        case MeshFormat::stl:
            return only_file(encode::write_stl(scene, options.ascii));
        case MeshFormat::obj:
            return encode::write_obj(scene, options.stem);
        case MeshFormat::glb:
            return only_file(encode::write_glb(scene));
        case MeshFormat::vrml:
            return only_file(encode::write_vrml(scene));
        case MeshFormat::x3d:
            return only_file(encode::write_x3d(scene));
        case MeshFormat::threemf:
            return only_file(encode::write_3mf(scene));
        case MeshFormat::pov:
            break;
    }
    return only_file(encode::write_pov(scene));
}

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

Result<EncodedFiles> encode_scene(const Scene& scene, MeshFormat format, const MeshEncodeOptions& options) {
    SceneView view{{}, scene.unit, scene.title, scene.author, scene.license, scene.source};
    for (const SceneObject& object : scene.objects) {
        view.objects.push_back({object.name, &object.mesh, in_range(object.material)});
    }
    return encode_view(view, format, options);
}

Result<std::string> encode_mesh(const Mesh& mesh, MeshFormat format, const MeshEncodeOptions& options) {
    Material material;
    if (!mesh.colors.empty()) material.base = {1, 1, 1};
    const SceneView view{{{"", &mesh, material}}, {"mm", 0.001}, "", "", "", ""};
    MeshEncodeOptions alone = options;
    alone.stem.clear();
    auto files = encode_view(view, format, alone);
    if (!files) return files.error();
    return std::move(files->bytes);
}

}  // namespace frep
