// Reading mesh files into a Scene: which formats there are, how a file is recognised, and its bytes decoded.
//   STL   binary and text; coordinates in binary32; equal positions become one vertex
//   PLY   1.0 (G. Turk), text and binary of both byte orders, any scalar types and further elements
//   OBJ   Wavefront: v (with colors), vn, f with polygons and negative indices, o and g, usemtl with MTL
//   files OFF   Geomview: OFF, COFF, NOFF, CNOFF, with or without ST; text glTF  2.0 (Khronos), .glb and
//   .gltf: nodes, strided and normalised accessors, strips and fans
// Readers trust no count of a file: what they allocate is bounded by a small multiple of the file's size,
// every index is checked, and a coordinate that is not finite is an error. Faces with more than three corners
// are split (read_polygon.h). Triangles that name a vertex twice and faces with fewer than three corners are
// dropped. Tested by tests/unit/io/read_*_test.cpp and fuzz/read_fuzzer.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/scene.h"

namespace frep {

enum class SceneReadFormat { stl, ply, obj, off, gltf };

/// "STL", "PLY", "OBJ", "OFF", "glTF".
std::string_view scene_read_format_name(SceneReadFormat format);

/// The format of a file with this name and content: by its first bytes where they are unmistakable (PLY,
/// GLB), else by the extension (.stl .ply .obj .off .glb .gltf, any case), else by what the content looks
/// like. Errors: invalid_argument when nothing fits.
Result<SceneReadFormat> scene_read_format(std::string_view path, std::string_view bytes);

/// The bytes of a file that the decoded file names (an MTL file, a glTF buffer). The name comes from the file
/// and is not to be trusted.
using ReadCompanion = std::function<Result<std::string>(std::string_view name)>;

struct ReadOptions {
    /// The unit of the scene: files without a unit are taken to be in it, the metres of glTF converted to it.
    LengthUnit unit{"mm", 0.001};
    /// Without it OBJ materials are left out, and glTF files that name further files are refused.
    ReadCompanion read_companion;
    /// glTF files can show a mesh many times: vertices and triangles that a scene may have beyond the number
    /// of bytes read.
    std::size_t instance_limit = 2'000'000;
};

/// What a reader says besides the scene.
struct ReadReport {
    bool unit_stated = false;          ///< the format fixes the unit (glTF)
    std::vector<std::string> dropped;  ///< what the file has and a Scene has not: "3 texture coordinates"
};

/// The scene in a file's bytes, in Z-up right-handed coordinates; every mesh is_valid() and finite. A file
/// without triangles gives a scene without, and no error. Errors: io for malformed content, with the place
/// (line or byte) and what was expected; over_limit for a file of 4 GiB and more and for too many instances.
Result<Scene> decode_scene(std::string_view bytes, SceneReadFormat format, const ReadOptions& options = {},
                           ReadReport* report = nullptr);

}  // namespace frep
