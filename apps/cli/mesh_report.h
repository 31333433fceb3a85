// The report of `frep mesh` (docs/cli.md) and the promises of `--require`. Tested by tests/cli/mesh.txt.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frep/frep.h"

namespace frep::cli {

/// What a run took; stands under "run" in the report, outside the promise of equal bytes.
struct RunFigures {
    double seconds = 0;
    int threads = 1;
    std::string_view engine;
};

/// The report as the bytes of a JSON file.
std::string report_bytes(const MeshReport& report, std::size_t undefined_points, const RunFigures& run);

/// A list of closed, manifold, oriented. Errors: an unknown word, or one that this version cannot check.
Result<std::vector<std::string>> parse_requirements(std::string_view text);

/// Why the mesh breaks one of the promises: a sentence for each that it breaks.
std::vector<std::string> broken_promises(const std::vector<std::string>& required, const MeshReport& report);

}  // namespace frep::cli
