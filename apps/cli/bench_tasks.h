// The tasks of `frep bench`: each prepares, runs some work of the library repeatedly, and tells what it did.
// What each measures stands in docs/performance.md. Tested by tests/cli/bench.txt.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bench_measure.h"
#include "model_input.h"

namespace frep::cli {

struct BenchOptions {
    bool binary32 = true;     ///< the profile of dense, gradient, picture and depth
    std::optional<int> size;  ///< in place of a task's own
    int repeat = 7;
    Box3 box = Box3::cube(1);  ///< where points, pixels and cells are
    int threads = 1;
    ContourMethod method = ContourMethod::adaptive;  ///< of the task mesh
};

/// What a run of a task did, and how long it took.
struct TaskOutcome {
    std::string_view task{};
    std::string_view profile{};  ///< "binary32", "binary64"; "mixed" for intervals
    int size = 0;
    double amount = 0;            ///< of `unit`, in one run
    std::string_view unit{};      ///< "lines", "points", "boxes", "pixels", "triangles"
    double tile_operations = 0;   ///< clauses run on boxes in one run
    double point_operations = 0;  ///< clauses run on points in one run; of loading, the clauses made
    Measured time{};
    Image picture{};  ///< of picture and depth
};

struct BenchTask {
    std::string_view name;
    std::string_view doc;
    Result<TaskOutcome> (*run)(const PreparedModel& prepared, const BenchOptions& options);
    bool needs_native_code = false;
};

/// load, dense, gradient, compile, native, interval, picture, depth, mesh.
std::span<const BenchTask> bench_tasks();

}  // namespace frep::cli
