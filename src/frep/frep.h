// The facade: everything a program needs to read HyperFun models, evaluate fields and make meshes.
// A Field is a real function of n coordinates; its shape is where the value is >= 0. See
// docs/architecture.md.
//
//     auto model = frep::compile_file("pot.hf");
//     auto mesh = frep::contour(model->field().value(), {.bounds = frep::Box3::cube(60)});
//     frep::write("pot.stl", mesh->mesh);
#pragma once

#include <string>
#include <string_view>

#include "frep/base/diagnostic.h"
#include "frep/base/job.h"
#include "frep/base/parallel.h"
#include "frep/base/result.h"
#include "frep/blend_diagnostics.h"
#include "frep/contour/adaptive.h"
#include "frep/contour/bounds.h"
#include "frep/contour/contour.h"
#include "frep/contour/contour_2d.h"
#include "frep/contour/mesh_error.h"
#include "frep/contour/occupancy.h"
#include "frep/contour/slices.h"
#include "frep/eval/batch_vm.h"
#include "frep/eval/clause_tape.h"
#include "frep/eval/evaluator.h"
#include "frep/eval/isa.h"
#include "frep/eval/native_code.h"
#include "frep/eval/plane.h"
#include "frep/eval/prune.h"
#include "frep/eval/sampled_field.h"
#include "frep/field/colored_union.h"
#include "frep/field/expression.h"
#include "frep/field/field.h"
#include "frep/geom/color.h"
#include "frep/geom/image.h"
#include "frep/geom/mesh.h"
#include "frep/geom/mesh_check.h"
#include "frep/geom/polyline.h"
#include "frep/geom/print_check.h"
#include "frep/geom/scene.h"
#include "frep/io/apng.h"
#include "frep/io/drawing_format.h"
#include "frep/io/file.h"
#include "frep/io/gif.h"
#include "frep/io/mesh_format.h"
#include "frep/io/png.h"
#include "frep/io/read_font.h"
#include "frep/io/read_mesh.h"
#include "frep/io/read_svg.h"
#include "frep/io/read_volume.h"
#include "frep/io/slice_format.h"
#include "frep/lang/explain.h"
#include "frep/lang/limits.h"
#include "frep/lang/model.h"
#include "frep/lang/pov_isosurface.h"
#include "frep/lang/rename.h"
#include "frep/measure/blend_check.h"
#include "frep/measure/collide.h"
#include "frep/measure/membership.h"
#include "frep/measure/shape_measure.h"
#include "frep/measure/space_field.h"
#include "frep/measure/surface_size.h"
#include "frep/shapes/library.h"
#include "frep/shapes/library_page.h"
#include "frep/trace/mosaic.h"
#include "frep/trace/plane_picture.h"
#include "frep/trace/plane_render.h"
#include "frep/trace/solid_picture.h"
#include "frep/trace/tile_depth.h"
#include "frep/trace/tile_sign.h"

namespace frep {

/// The version of the library, "0.1.0", and the numeric profile: raised whenever a value changes
/// (docs/numerics.md).
std::string_view version();
int numeric_profile();

/// The model in HyperFun `text`; `name` stands in messages. Errors: invalid_model with the rendered
/// diagnostics.
Result<Model> compile(std::string_view text, std::string name = "model.hf");

/// The model in the file `path`, HyperFun or, by its extension, `.vm`. Files that it names are read from its
/// folder only (no links, 1 GiB at most).
/// Errors: as compile(); io and over_limit when the file cannot be read.
Result<Model> compile_file(const std::string& path);

/// Reads a file that a model in `folder` names: inside the folder, no links on the way, 1 GiB at most.
ReadFile files_of_folder(std::string folder);

/// The surface of a field of up to three coordinates (further ones frozen at 0) as a triangle mesh, by dual
/// contouring: closed where the box does not cut it, without self-intersections, sharp edges kept. With
/// options.tolerance flat parts get larger triangles; options.method chooses uniform cells.
/// Errors: those of contour_solid() (contour/adaptive.h); invalid_argument for a field without an engine.
Result<ContourResult> contour(const Field& field, const ContourOptions& options = {}, const Job& job = {});

/// Writes a mesh, or a scene with its side files; the format follows the extension (mesh_format_from_path).
/// Errors: invalid_argument, over_limit, io.
Status write(const std::string& path, const Mesh& mesh, const MeshEncodeOptions& options = {});
Status write(const std::string& path, const Scene& scene, const MeshEncodeOptions& options = {});

}  // namespace frep
