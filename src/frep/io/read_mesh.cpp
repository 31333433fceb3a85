// Implementation of read_mesh.h: recognising formats, and what all readers end with.
#include "frep/io/read_mesh.h"

#include <fmt/format.h>

#include <array>

#include "frep/base/source.h"
#include "frep/io/read_formats.h"

namespace frep {

namespace {

struct Extension {
    std::string_view name;
    SceneReadFormat format;
};
constexpr std::array extensions{
    Extension{".stl", SceneReadFormat::stl},  Extension{".ply", SceneReadFormat::ply},
    Extension{".obj", SceneReadFormat::obj},  Extension{".off", SceneReadFormat::off},
    Extension{".glb", SceneReadFormat::gltf}, Extension{".gltf", SceneReadFormat::gltf}};

std::string extension_of(std::string_view path) {
    const std::size_t slash = path.find_last_of('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const std::size_t dot = name.find_last_of('.');
    return lower_case(dot == std::string_view::npos ? "" : name.substr(dot));
}

/// True for bytes that are binary STL by their size.
bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= 84 &&
           84 + std::uint64_t{50} * reading::load<std::uint32_t>(bytes.data() + 80) == bytes.size();
}

/// What the first words look like.
bool guess_format(std::string_view bytes, SceneReadFormat& format) {
    std::string_view word;
    if (!reading::Words(bytes.substr(0, 4096), true).next(word)) return false;
    if (word.front() == '{') return format = SceneReadFormat::gltf, true;
    if (word == "solid") return format = SceneReadFormat::stl, true;
    if (word.size() <= 6 && word.ends_with("OFF")) return format = SceneReadFormat::off, true;
    for (const std::string_view keyword : {"v", "vn", "vt", "o", "g", "mtllib", "usemtl", "f"})
        if (word == keyword) return format = SceneReadFormat::obj, true;
    return false;
}

/// Normals become unit vectors where they are not; without one that is finite there are none at all.
void clean_normals(Mesh& mesh, ReadReport& report) {
    for (Vec3& n : mesh.normals) {
        const double square = dot(n, n);
        if (!reading::is_finite(square)) {
            reading::note_dropped(report, mesh.normals.size(), "normal, one of them not finite");
            mesh.normals.clear();
            return;
        }
        if (square > 0.999 && square < 1.001) continue;
        const double size = length(n);
        n = size > 0 ? n / size : Vec3{0, 0, 0};
    }
}

Result<Scene> decode(std::string_view bytes, SceneReadFormat format, reading::Context& context) {
    switch (format) {
        case SceneReadFormat::stl:
            return reading::read_stl(bytes, context);
        case SceneReadFormat::ply:
            return reading::read_ply(bytes, context);
        case SceneReadFormat::obj:
            return reading::read_obj(bytes, context);
        case SceneReadFormat::off:
            return reading::read_off(bytes, context);
        case SceneReadFormat::gltf:
            break;
    }
    return reading::read_gltf(bytes, context);
}

}  // namespace

std::string_view scene_read_format_name(SceneReadFormat format) {
    constexpr std::array<std::string_view, 5> names{"STL", "PLY", "OBJ", "OFF", "glTF"};
    return names[static_cast<std::size_t>(format)];
}

Result<SceneReadFormat> scene_read_format(std::string_view path, std::string_view bytes) {
    if (bytes.starts_with("glTF")) return SceneReadFormat::gltf;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return SceneReadFormat::ply;
    const std::string extension = extension_of(path);
    for (const Extension& known : extensions)
        if (extension == known.name) return known.format;
    SceneReadFormat format = SceneReadFormat::stl;
    if (is_binary_stl(bytes) || guess_format(bytes, format)) return format;
    return Error{
        ErrorKind::invalid_argument,
        fmt::format("'{}' is no mesh file that can be read; those are .stl .ply .obj .off .glb .gltf", path)};
}

Result<Scene> decode_scene(std::string_view bytes, SceneReadFormat format, const ReadOptions& options,
                           ReadReport* report) {
    ReadReport unread;
    reading::Context context{options, report ? *report : unread};
    if (bytes.size() > 0xffffffffu) return Error{ErrorKind::over_limit, "the file has 4 GiB or more"};
    auto scene = decode(bytes, format, context);
    if (!scene) return scene;
    scene->unit = options.unit;
    for (SceneObject& object : scene->objects) clean_normals(object.mesh, context.report);
    return scene;
}

}  // namespace frep
