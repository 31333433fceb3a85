// Mesh file formats: which there are and a mesh as the bytes of one of them.
//   OFF  Geomview object file format: text, coordinates in binary64, no normals.
//   PLY  Stanford polygon format 1.0 (G. Turk): binary little endian or text, binary32, with normals.
//   STL  3D Systems stereolithography: binary or text, binary32, one normal a facet.
// Numbers are the shortest decimals that read back to the same binary number. No file carries a date.
// Tested by tests/unit/io/mesh_format_test.cpp.
#pragma once

#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/geom/mesh.h"

namespace frep {

enum class MeshFormat { off, ply, stl };

/// The format that the extension of `path` names (.off .ply .stl, any case). Errors: invalid_argument for
/// another or no extension.
Result<MeshFormat> mesh_format_from_path(std::string_view path);

struct MeshEncodeOptions {
    bool ascii = false;  ///< PLY and STL as text; OFF is always text
};

/// The mesh as a file's bytes; an empty mesh gives a valid file without triangles. Errors: invalid_argument
/// for a mesh that is not valid or a coordinate that the format cannot hold (not finite, or beyond binary32
/// in PLY and STL), over_limit for more vertices or triangles than the format can count.
Result<std::string> encode_mesh(const Mesh& mesh, MeshFormat format, const MeshEncodeOptions& options = {});

}  // namespace frep
