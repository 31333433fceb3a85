// What the tests of the readers share: decoding with its report, and writing files by hand.
#pragma once

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "frep/io/read_mesh.h"

namespace frep::test {

struct Decoded {
    Scene scene;
    ReadReport report;
};

inline Decoded decoded(std::string_view bytes, SceneReadFormat format, const ReadOptions& options = {}) {
    Decoded out;
    auto scene = decode_scene(bytes, format, options, &out.report);
    if (!scene) FAIL_CHECK(scene.error().message);
    REQUIRE(bool(scene));
    out.scene = std::move(*scene);
    for (const SceneObject& object : out.scene.objects) CHECK(is_valid(object.mesh));
    return out;
}

/// The only mesh of a file.
inline Mesh only_mesh(std::string_view bytes, SceneReadFormat format) {
    Decoded all = decoded(bytes, format);
    REQUIRE(all.scene.objects.size() == 1);
    return all.scene.objects[0].mesh;
}

/// The message of the error that decoding must give.
inline std::string refusal(std::string_view bytes, SceneReadFormat format, const ReadOptions& options = {}) {
    const auto scene = decode_scene(bytes, format, options);
    REQUIRE_FALSE(bool(scene));
    CHECK(scene.error().kind == ErrorKind::io);
    return scene.error().message;
}

/// Numbers as bytes, one after the other.
struct Bytes {
    std::string out;
    bool big_endian = false;

    template <class Number>
    Bytes& add(Number value) {
        char bytes[sizeof value];
        __builtin_memcpy(bytes, &value, sizeof value);  // the tests run on little-endian machines
        for (std::size_t i = 0; i < sizeof value; ++i)
            out.push_back(bytes[big_endian ? sizeof value - 1 - i : i]);
        return *this;
    }
    Bytes& text(std::string_view more) {
        out += more;
        return *this;
    }
};

inline bool near(const Vec3& a, const Vec3& b, double tolerance = 0) {
    const Vec3 d = a - b;
    return d.x <= tolerance && d.x >= -tolerance && d.y <= tolerance && d.y >= -tolerance &&
           d.z <= tolerance && d.z >= -tolerance;
}

}  // namespace frep::test
