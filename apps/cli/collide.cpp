// `frep collide`: whether two models have points in common, with a point or a proof.
// Tested by tests/cli/collide.txt.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "box.h"
#include "command_line.h"
#include "json.h"
#include "mesh_report.h"
#include "model_input.h"
#include "terminal.h"
#include "time_keeper.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct CollideTexts {
    ModelOptions first, second;
    std::optional<std::string> bounds, tolerance, cells;
    bool json = false;
};

/// The box that the shapes share: what lies in one of their boxes only cannot be common.
Box3 common_box(const Box3& a, const Box3& b) {
    return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
            {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}

bool is_empty(const Box3& box, const std::array<bool, 3>& axes) {
    return (axes[0] && !(box.min.x < box.max.x)) || (axes[1] && !(box.min.y < box.max.y)) ||
           (axes[2] && !(box.min.z < box.max.z));
}

class CollideRun {
  public:
    CollideRun(const CollideTexts& texts, const PreparedModel& first, const PreparedModel& second,
               std::optional<double> time_limit)
        : texts_(texts), first_(first), second_(second), time_limit_(time_limit) {
        job_.threads = first.threads;
    }

    int run() {
        CollideOptions options;
        options.evaluator = first_.evaluator;
        for (int axis = 0; axis < 3; ++axis)
            options.axes[static_cast<std::size_t>(axis)] = first_.map.uses(axis) || second_.map.uses(axis);
        if (texts_.tolerance) {
            const auto tolerance = parse_positive(*texts_.tolerance);
            if (!tolerance) return usage_error("--tolerance: " + tolerance.error().message);
            options.tolerance = *tolerance;
        }
        if (texts_.cells) {
            const auto cells = parse_integer(*texts_.cells, 8, 100'000'000);
            if (!cells) return usage_error("--cells: " + cells.error().message);
            options.max_cells = static_cast<std::size_t>(*cells);
        }
        std::optional<StatedBounds> stated;
        if (texts_.bounds) {
            const auto box = parse_bounds(*texts_.bounds);
            if (!box) return usage_error("--bounds: " + box.error().message);
            stated = *box;
        }
        std::array<Box3, 2> boxes;
        std::array<Field, 2> fields;
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            const PreparedModel& prepared = k == 0 ? first_ : second_;
            const auto sampled = sampled_field(prepared);
            if (!sampled) return fail(sampled.error());
            const auto box = choose_box(prepared, stated, **sampled, job_);
            if (!box) return fail(box.error());
            boxes[k] = *box;
            const auto field = field_in_space(prepared.field(), prepared.map);
            if (!field) return fail(field.error());
            fields[k] = *field;
        }
        options.bounds = common_box(boxes[0], boxes[1]);
        if (is_empty(options.bounds, options.axes)) return tell({}, options.axes);
        const TimeKeeper keeper(job_, time_limit_);
        const auto result = collide(fields[0], fields[1], options, job_);
        if (!result) return fail(result.error());
        return tell(*result, options.axes);
    }

  private:
    int tell(const CollideResult& found, const std::array<bool, 3>& axes) const {
        constexpr std::string_view names[] = {"apart", "touching", "collide"};
        const std::string_view name = names[static_cast<int>(found.kind)];
        const bool is_apart = found.kind == Collision::apart;
        std::vector<double> point;
        const std::array<double, 3> witness{found.witness.x, found.witness.y, found.witness.z};
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (axes[axis]) point.push_back(witness[axis]);
        if (texts_.json) {
            const Json out = {
                {"schema", "frep.collide/1"},
                {"result", name},
                {"witness", is_apart ? Json(nullptr) : point_json(found.witness)},
                {"depth", is_apart ? Json(nullptr) : json_number(found.depth)},
                {"resolution", found.kind == Collision::touching ? Json(found.cell) : Json(nullptr)},
                {"cells", found.evaluated}};
            if (const int code = print_result(json_bytes(out))) return code;
        } else {
            std::string text = fmt::format("{}: proved\n", name);
            if (found.kind == Collision::collide)
                text = fmt::format("{} at {}, where the smaller function is {}\n", name, point_text(point),
                                   number_text(found.depth));
            if (found.kind == Collision::touching)
                text = fmt::format(
                    "{} near {}: no point inside both was found, and no proof that there is none, "
                    "in cells of {}\n",
                    name, point_text(point), number_text(found.cell));
            if (const int code = print_result(text)) return code;
        }
        if (found.is_cancelled && found.kind == Collision::touching) {
            print_error("stopped at the time limit");
            return exit_over_limit;
        }
        return is_apart ? exit_ok : exit_check_failed;
    }

    const CollideTexts& texts_;
    const PreparedModel& first_;
    const PreparedModel& second_;
    std::optional<double> time_limit_;
    Job job_;
};

}  // namespace

int run_collide(Arguments arguments) {
    CollideTexts texts;
    CommandLine line(
        "collide", "collide FIRST SECOND [options]",
        "Tells whether two models have points in common: a point inside both, or a proof that they "
        "are apart.",
        {"frep collide lid.hf pot.hf", "frep collide arm.hf frame.hf --param angle=30 --json",
         "frep collide part.hf part.hf --object lid --second-object base"});
    declare_model_options(line, texts.first);
    line.positional("SECOND", texts.second.input, "HyperFun file of the other model");
    line.text("--second-object", texts.second.object, "NAME", "object of the second model");
    line.text("--second-a", texts.second.values, "V,V,...", "parameters of the second model");
    line.texts("--second-param", texts.second.named_values, "NAME=V",
               "one parameter of the second model (repeatable)");
    line.text("--second-map", texts.second.map, "MAP", "map of the second model's coordinates");
    line.text("--bounds", texts.bounds, "BOX", "where to look (default: what the boxes of the models share)");
    line.text("--tolerance", texts.tolerance, "LENGTH",
              "cells this small are not divided any more (default 1e-6)");
    line.text("--cells", texts.cells, "N", "undecided cells held at most (default 20000)");
    line.flag("--json", texts.json, "the answer as one JSON object on standard output");
    if (const auto code = line.parse(arguments)) return *code;
    if (texts.first.input == "-" && texts.second.input == "-")
        return usage_error("the two models cannot both come from standard input");
    texts.second.engine = texts.first.engine;
    texts.second.max_steps = texts.first.max_steps;
    texts.second.threads = texts.first.threads;
    texts.second.no_lift = texts.first.no_lift;
    int code = exit_ok;
    const auto first = prepare_model(texts.first, code);
    if (!first) return code;
    const auto second = prepare_model(texts.second, code);
    if (!second) return code;
    return CollideRun(texts, *first, *second, line.time_limit()).run();
}

}  // namespace frep::cli
