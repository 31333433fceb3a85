// The writers of the mesh formats (private to io), each in a file of its own, write_*.cpp. They take a
// checked scene by reference, so that a single mesh is not copied.
// Tested by tests/unit/io/mesh_format_test.cpp and its neighbours.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frep/base/result.h"
#include "frep/geom/scene.h"
#include "frep/io/encoded_files.h"

namespace frep::encode {

struct ObjectView {
    std::string_view name;
    const Mesh* mesh = nullptr;
    Material material;
};

struct SceneView {
    std::vector<ObjectView> objects;
    LengthUnit unit;
    std::string_view title, author, license, source;
};

std::string write_off(const SceneView& scene);
std::string write_ply(const SceneView& scene, bool ascii);
std::string write_stl(const SceneView& scene, bool ascii);
EncodedFiles write_obj(const SceneView& scene, std::string_view stem);
Result<std::string> write_glb(const SceneView& scene);
std::string write_vrml(const SceneView& scene);
std::string write_x3d(const SceneView& scene);
Result<std::string> write_3mf(const SceneView& scene);
std::string write_pov(const SceneView& scene);

/// The unit of a 3MF model for lengths in `unit`, and the factor to it: 1 where the format knows the unit,
/// else the one to millimetres.
struct Scale3mf {
    std::string_view unit;
    double factor = 1;
};
Scale3mf scale_3mf(const LengthUnit& unit);

// --- what several writers need

/// The color of vertex `i`: the material's base color, times the vertex's own in linear light if the mesh
/// has colors (exactly the vertex's color when the base is white).
Color vertex_color(const ObjectView& object, std::size_t i);

/// `n` with length 1; the zero vector if it has no direction.
Vec3 unit_or_zero(Vec3 n);

/// The mesh's normals with length 1. One without direction is replaced by the mean of the triangles at the
/// vertex, and by (0, 0, 1) where that has none either. Empty when the mesh has no normals.
std::vector<Vec3> unit_normals(const Mesh& mesh);

/// The unit normal of a triangle by the right-hand rule; zero for a degenerate one.
Vec3 facet_normal(const Mesh& mesh, const Triangle& t);

/// The triangles whose corners are three different vertices.
std::vector<Triangle> proper_triangles(const std::vector<Triangle>& triangles);

/// True if every edge lies in exactly two triangles, which run through it in opposite directions, and there
/// is a triangle. Sorts the edges: 24 bytes a triangle.
bool is_closed(const std::vector<Triangle>& triangles);

/// The different 8-bit colors of a mesh, sorted; a color is 0xRRGGBB.
struct Palette {
    std::vector<std::uint32_t> colors;
    std::uint32_t index(std::uint32_t color) const;  ///< of a color that is in it
};
std::uint32_t color_bits(const Color& color);
Palette palette_of(const ObjectView& object);

/// Appends "#RRGGBB".
void append_hex_color(std::string& out, std::uint32_t color);

}  // namespace frep::encode
