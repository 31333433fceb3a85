// libFuzzer target: the readers of mesh files. The first byte chooses the format, the rest is the file; every
// file that it names has the bytes of the file itself. A scene that comes out must be valid, finite and no
// larger than the file allows.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "frep/io/read_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    constexpr std::size_t instances = 20'000;
    frep::ReadOptions options;
    options.instance_limit = instances;
    options.read_companion = [bytes](std::string_view) {
        return frep::Result<std::string>(std::string(bytes));
    };
    frep::ReadReport report;
    static_cast<void>(frep::scene_read_format("file", bytes));
    const auto scene =
        frep::decode_scene(bytes, static_cast<frep::SceneReadFormat>(data[0] % 5), options, &report);
    if (!scene) return 0;
    std::size_t elements = 0;
    for (const frep::SceneObject& object : scene->objects) {
        if (!frep::is_valid(object.mesh)) std::abort();
        for (const frep::Vec3& v : object.mesh.vertices)
            if ((v.x - v.x) + (v.y - v.y) + (v.z - v.z) != 0) std::abort();
        elements += object.mesh.vertices.size() + object.mesh.triangles.size();
    }
    // glTF buffers in further files count with their own bytes, of which there are at most 64.
    if (elements > 2 * 65 * (size + instances)) std::abort();
    return 0;
}
