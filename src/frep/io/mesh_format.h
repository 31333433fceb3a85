// Mesh file formats: which there are and a scene as the bytes of one of them.
//   OFF   Geomview object file format: text, coordinates in binary64, COFF with colors.
//   PLY   Stanford polygon format 1.0 (G. Turk): binary little endian or text, normals, 8-bit colors.
//   STL   3D Systems stereolithography: binary or text, one normal a facet.
//   OBJ   Wavefront, with a material library (.mtl) as side file.
//   GLB   glTF 2.0 (ISO/IEC 12113:2022), binary, with KHR_materials_clearcoat: metres, Y up.
//   WRL   VRML 97 (ISO/IEC 14772-1): metres, Y up.
//   X3D   X3D 3.3 (ISO/IEC 19775-1:2013) in XML, profile Interchange: metres, Y up.
//   3MF   3MF Core Specification 1.3 with the Materials Extension 1.2: a zip package.
//   POV   mesh2 of POV-Ray 3.7, left-handed: Y and Z change places.
// docs/formats.md has the table of what each keeps. Numbers are the shortest decimals that read back to the
// same binary number. No file carries a date.
// Tested by tests/unit/io/mesh_format_test.cpp and, with other programs as judges, by tests/validators.
#pragma once

#include <string>
#include <string_view>

#include "frep/base/result.h"
#include "frep/geom/mesh.h"
#include "frep/geom/scene.h"
#include "frep/io/encoded_files.h"

namespace frep {

enum class MeshFormat { off, ply, stl, obj, glb, vrml, x3d, threemf, pov };

/// The format that the extension of `path` names (.off .ply .stl .obj .glb .wrl .x3d .3mf .pov, any case).
/// Errors: invalid_argument for another or no extension.
Result<MeshFormat> mesh_format_from_path(std::string_view path);

struct MeshEncodeOptions {
    bool ascii = false;  ///< PLY and STL as text; the others are always text or always binary
    /// The main file's name without folder and extension (stem_of_path). The side file of an OBJ is called
    /// after it; without it there is no side file.
    std::string stem = {};
};

/// The scene as a file's bytes, with its side files. Objects stay apart in the formats that know objects and
/// are joined in OFF, PLY and STL; a scene without triangles gives a valid file. Where a mesh has colors, an
/// object's color is the product of vertex and base color in linear light (scene.h). Errors:
/// invalid_argument for a mesh that is not valid or a coordinate that the format cannot hold (not finite, or
/// beyond binary32 except in OFF), over_limit for more vertices or triangles than the format can count.
Result<EncodedFiles> encode_scene(const Scene& scene, MeshFormat format,
                                  const MeshEncodeOptions& options = {});

/// One mesh without a name, in millimetres, as a file's bytes; side files are dropped. Its base color is
/// white where it has colors. Errors: as of encode_scene.
Result<std::string> encode_mesh(const Mesh& mesh, MeshFormat format, const MeshEncodeOptions& options = {});

}  // namespace frep
