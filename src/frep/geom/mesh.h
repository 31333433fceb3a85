// Mesh: an indexed triangle mesh, plain data. Triangles are counter-clockwise seen from outside, so that the
// right-hand rule gives the outward normal and a closed mesh has a positive volume.
// Tested by tests/unit/geom/mesh_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/geom/color.h"
#include "frep/math/vec.h"

namespace frep {

/// Three indices into Mesh::vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh in model units. `normals` is empty or holds one outward unit normal a vertex; `colors` is
/// empty or holds one color a vertex.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
    std::vector<Color> colors;
    std::vector<Triangle> triangles;
};

/// True when every index of every triangle names a vertex and `normals` and `colors` are empty or as long as
/// `vertices`. Every verb on meshes asks for it.
bool is_valid(const Mesh& mesh);

/// `value` as a binary32 number holds it. A function of its own on purpose: where g++ 12 sees two such
/// conversions side by side it vectorizes them and loses the rounding (from -O2 on).
double rounded_to_binary32(double value);

struct MergeOptions {
    bool as_float32 = true;  ///< round the coordinates to binary32 first, as the binary file formats do
};

/// `mesh` with vertices at equal positions merged into the first of them (-0 equals +0) and the triangles
/// dropped that name a vertex twice after that. Vertices keep their order; their normal and color are
/// those of the first. Vertices that no triangle names stay.
Mesh merge_equal_positions(const Mesh& mesh, const MergeOptions& options = {});

/// True when two corners of the triangle `t` of `mesh` are at equal positions, so that merging drops it.
bool collapses(const Mesh& mesh, const Triangle& t, const MergeOptions& options = {});

/// For every vertex the unit mean of its triangles' normals, weighted by area (the cross products summed in
/// triangle order); the zero vector where they cancel or no triangle names the vertex.
std::vector<Vec3> mean_normals(const Mesh& mesh);

}  // namespace frep
