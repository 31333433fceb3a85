// The verbs of the command: one file each. A verb gets the arguments after its name and gives the exit code.
// Contract: docs/cli.md.
#pragma once

#include <span>
#include <string>

namespace frep::cli {

/// Exit codes; they never change their meaning.
enum ExitCode : int {
    exit_ok = 0,
    exit_invalid_model = 1,
    exit_usage = 2,
    exit_check_failed = 3,
    exit_io = 4,
    exit_over_limit = 5,
    exit_interrupted = 130,
};

using Arguments = std::span<const std::string>;

int run_check(Arguments arguments);
int run_info(Arguments arguments);
int run_explain(Arguments arguments);
int run_eval(Arguments arguments);
int run_mesh(Arguments arguments);
int run_convert(Arguments arguments);
int run_field(Arguments arguments);
int run_render(Arguments arguments);
int run_morph(Arguments arguments);
int run_animate(Arguments arguments);
int run_measure(Arguments arguments);
int run_collide(Arguments arguments);
int run_bench(Arguments arguments);

}  // namespace frep::cli
