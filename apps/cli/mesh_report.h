// The report of `frep mesh` (docs/cli.md, docs/formats.md) and the promises of `--require`.
// Tested by tests/cli/mesh.txt and mesh_report.txt.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/frep.h"
#include "json.h"

namespace frep::cli {

/// What a run took; stands under "run" in the report, outside the promise of equal bytes.
struct RunFigures {
    double seconds = 0;
    int threads = 1;
    std::string_view engine;
};
Json run_json(const RunFigures& run);
Json point_json(Vec3 p);
Json point_json(Vec2 p);

/// One object of the scene.
struct ObjectFigures {
    std::string name;
    std::size_t vertices = 0, triangles = 0;
};

/// What is told of a mesh beside its MeshReport.
struct MeshFigures {
    std::uint64_t undefined_points = 0;
    std::uint64_t tight_cells = 0, hidden_cells = 0;  ///< as in ContourResult
    std::optional<Vec3> first_undefined;
    std::optional<MeshError> error;
    std::string_view unit;
    std::vector<ObjectFigures> objects;
};

/// The report without "run".
Json mesh_json(const MeshReport& report, const MeshFigures& figures);

/// A list of closed, manifold, oriented, no-self-intersection, resolved. Errors: an unknown word.
Result<std::vector<std::string>> parse_requirements(std::string_view text);

/// Whether "resolved" is among the promises: that no wall or gap is too thin for the cells.
bool requires_resolved(const std::vector<std::string>& required);

/// Why the mesh breaks one of the promises: a sentence for each that it breaks.
std::vector<std::string> broken_promises(const std::vector<std::string>& required, const MeshReport& report,
                                         const MeshFigures& figures);

}  // namespace frep::cli
