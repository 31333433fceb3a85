// Small scenes for the tests of the writers.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "frep/io/mesh_format.h"
#include "unit/geom/shapes.h"

namespace frep::test {

/// A tetrahedron with red, green, blue and white corners under a white base, and a plain one beside it, with
/// normals, of gold, with names that every syntax has to escape.
inline Scene two_tetrahedra() {
    Scene scene;
    Mesh colored = tetrahedron();
    colored.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    scene.objects.push_back({"a<b>&\"c\"", colored, {{1, 1, 1}, 0, 0.5, 0}});
    Mesh plain = tetrahedron({2, 0, 0});
    plain.normals = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    scene.objects.push_back({"a<b>&\"c\"", plain, {{1, 0.5, 0}, 1, 0.25, 1}});
    scene.title = "T<1>\n";
    scene.author = "\xc3\x84";
    scene.license = "CC0";
    scene.source = "a & b";
    return scene;
}

inline EncodedFiles encoded_files(const Scene& scene, MeshFormat format,
                                  const MeshEncodeOptions& options = {}) {
    auto files = encode_scene(scene, format, options);
    REQUIRE(static_cast<bool>(files));
    return *files;
}

inline std::string encoded(const Scene& scene, MeshFormat format, bool ascii = false) {
    return encoded_files(scene, format, {.ascii = ascii}).bytes;
}

inline std::size_t count_of(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

inline bool contains(std::string_view text, std::string_view part) { return count_of(text, part) > 0; }

}  // namespace frep::test
