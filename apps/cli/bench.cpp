// `frep bench`: how long the tasks of bench_tasks.h take, as a table or as JSON. Tested by
// tests/cli/bench.txt.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "bench_tasks.h"
#include "command_line.h"
#include "json.h"
#include "picture_file.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct BenchTexts {
    ModelOptions model;
    std::optional<std::string> tasks, size, profile, repeat, bounds, method, output;
    bool json = false;
};

/// The tasks that `text` names; an unknown one is printed.
std::optional<std::vector<BenchTask>> choose_tasks(const std::string& text) {
    const auto all = bench_tasks();
    std::vector<BenchTask> chosen;
    std::vector<std::string_view> names{"all"};
    for (const BenchTask& task : all) names.push_back(task.name);
    for (const std::string_view name : split_at_commas(text)) {
        if (name == "all") {
            chosen.assign(all.begin(), all.end());
            continue;
        }
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const BenchTask& task) { return task.name == name; });
        if (found == all.end()) {
            print_error(fmt::format("--task: no task `{}`", name));
            const std::string_view near = nearest_name(name, names);
            print_help_line(near.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                                         : fmt::format("did you mean `{}`?", near));
            return std::nullopt;
        }
        chosen.push_back(*found);
    }
    return chosen;
}

/// Everything but the model; false when something is wrong, which is printed.
bool read_options(const BenchTexts& texts, BenchOptions& out) {
    if (texts.profile && *texts.profile != "binary32" && *texts.profile != "binary64")
        return usage_error("--profile: binary32 or binary64"), false;
    out.binary32 = texts.profile.value_or("binary32") == "binary32";
    if (texts.size) {
        const auto size = parse_integer(*texts.size, 1, 16384);
        if (!size) return usage_error("--size: " + size.error().message), false;
        out.size = static_cast<int>(*size);
    }
    if (texts.repeat) {
        const auto repeat = parse_integer(*texts.repeat, 1, 10000);
        if (!repeat) return usage_error("--repeat: " + repeat.error().message), false;
        out.repeat = static_cast<int>(*repeat);
    }
    if (texts.bounds) {
        const auto box = parse_bounds(*texts.bounds);
        if (!box) return usage_error("--bounds: " + box.error().message), false;
        out.box = box->box;
        if (box->is_flat) out.box.min.z = -1, out.box.max.z = 1;
    }
    if (texts.method && *texts.method != "adaptive" && *texts.method != "cells")
        return usage_error("--method: adaptive or cells"), false;
    if (texts.method == "cells") out.method = ContourMethod::cells;
    return true;
}

Json spread_json(const Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json outcome_json(const TaskOutcome& outcome) {
    return {{"task", outcome.task},
            {"profile", outcome.profile},
            {"size", outcome.size},
            {"amount", outcome.amount},
            {"unit", outcome.unit},
            {"tile_operations", outcome.tile_operations},
            {"point_operations", outcome.point_operations},
            {"cpu_ms", spread_json(outcome.time.cpu)},
            {"wall_ms", spread_json(outcome.time.wall)}};
}

std::string outcome_line(const TaskOutcome& outcome) {
    const Spread& cpu = outcome.time.cpu;
    const double rate = outcome.amount / std::max(cpu.median, 1e-6) / 1e3;
    return fmt::format(
        "{:<9} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}  {} {}, {:.4g} M a second; {:.4g} M operations"
        " on boxes, {:.4g} M on points\n",
        outcome.task, cpu.median, cpu.min, cpu.max, outcome.time.wall.median, outcome.amount, outcome.unit,
        rate, 1e-6 * outcome.tile_operations, 1e-6 * outcome.point_operations);
}

int write_last_picture(const std::vector<TaskOutcome>& outcomes, const Model& model,
                       const std::string& path) {
    for (auto outcome = outcomes.rbegin(); outcome != outcomes.rend(); ++outcome)
        if (outcome->picture.width > 0) return write_picture(outcome->picture, model, path);
    return usage_error("-o needs the task picture or depth");
}

int bench(BenchTexts& texts) {
    const auto tasks = choose_tasks(texts.tasks.value_or("all"));
    if (!tasks) return exit_usage;
    BenchOptions options;
    if (!read_options(texts, options)) return exit_usage;
    if (!texts.model.threads) texts.model.threads = "1";
    int code = exit_ok;
    const auto prepared = prepare_model(texts.model, code);
    if (!prepared) return code;
    options.threads = prepared->threads;

    std::vector<TaskOutcome> outcomes;
    for (const BenchTask& task : *tasks) {
        if (task.needs_native_code && !NativeCode<float>::is_available()) {
            print_warning(fmt::format("{}: this build or this machine makes no native code", task.name));
            continue;
        }
        auto outcome = task.run(*prepared, options);
        if (!outcome) return fail(outcome.error());
        outcomes.push_back(std::move(*outcome));
    }
    if (texts.output)
        if (const int failure = write_last_picture(outcomes, prepared->model, *texts.output)) return failure;
    if (texts.json) {
        Json list = Json::array();
        for (const TaskOutcome& outcome : outcomes) list.push_back(outcome_json(outcome));
        return print_result(json_bytes({{"schema", "frep.bench/1"},
                                        {"model", json_text(prepared->model.source().name())},
                                        {"version", version()},
                                        {"instruction_set", name_of(machine_isa())},
                                        {"threads", options.threads},
                                        {"repeat", options.repeat},
                                        {"lifted", prepared->lowered.lifted.total()},
                                        {"tasks", std::move(list)},
                                        {"peak_memory_bytes", peak_memory()}}));
    }
    std::string out =
        fmt::format("{:<9} {:>10} {:>10} {:>10} {:>10}\n", "task", "cpu ms", "min", "max", "wall ms");
    for (const TaskOutcome& outcome : outcomes) out += outcome_line(outcome);
    return print_result(out);
}

}  // namespace

int run_bench(Arguments arguments) {
    BenchTexts texts;
    CommandLine line(
        "bench", "bench MODEL [options]",
        "Runs tasks repeatedly and prints the medians of the processor time, with least and greatest.",
        {"frep bench prospero.vm --task load,picture", "frep bench pot.hf --task depth --size 512 -o pot.png",
         "frep bench csg100.vm --repeat 21 --json > csg100.json"});
    declare_model_options(line, texts.model);
    std::string doc = "which: all, or";
    for (const BenchTask& task : bench_tasks()) doc += fmt::format(" {},", task.name);
    doc.back() = ' ';
    line.text("--task", texts.tasks, "LIST", doc + "(default all)");
    line.text("--size", texts.size, "N", "pixels, voxels, cells or points, in place of each task's own");
    line.text("--profile", texts.profile, "NAME", "binary32 (default) or binary64, for points and pictures");
    line.text("--repeat", texts.repeat, "K", "runs of a task after the first (default 7)");
    line.text("--bounds", texts.bounds, "BOX", "the box of the tasks (default -1,1)");
    line.text("--method", texts.method, "METHOD", "of the task mesh: adaptive (default) or cells");
    line.text("-o,--output", texts.output, "FILE.png",
              "the last picture: inside white, or normals as colors");
    line.flag("--json", texts.json, "as one JSON object on standard output");
    if (const auto code = line.parse(arguments)) return *code;
    return bench(texts);
}

}  // namespace frep::cli
