// `frep morph`: two models become one with time as its last coordinate, by space-time bounded blending, as a
// readable HyperFun file. Tested by tests/cli/morph.txt.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "box.h"
#include "budget.h"
#include "command_line.h"
#include "frame_report.h"
#include "morph_text.h"
#include "surface_slope.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct MorphOptions {
    ModelOptions first, second;
    std::optional<std::string> output, time, a0, a1, a2, a3, b0, smoothing;
    bool plain = false;
};

constexpr double usual_range = 8;  ///< of the values of a shape
constexpr int trial_frames = 41, trial_cells_flat = 96, trial_cells_solid = 32;
constexpr double least_share = 0.5;  ///< of the smaller shape, that every frame must have

constexpr int doublings = 9, halvings = 3;  ///< of the displacement, in the search for it

Error usage(std::string message) { return {ErrorKind::invalid_argument, std::move(message)}; }

/// To so many decimal digits; NaN stays.
double rounded(double value, int digits) {
    const auto number = parse_number(fmt::format("{:.{}g}", value, digits));
    return number ? *number : value;
}

class MorphRun {
  public:
    MorphRun(const MorphOptions& options, const PreparedModel& first, const PreparedModel& second)
        : options_(options) {
        plan_.parts = {&first, &second};
        plan_.plain = options.plain;
        job_.threads = first.threads;
    }

    int run() {
        if (const Status status = read_numbers(); !status) return fail(status.error());
        if (const Status status = check_models(); !status) return fail(status.error());
        if (const Status status = find_range(); !status) return fail(status.error());
        if (!options_.a0)
            if (const Status status = find_strength(); !status) return fail(status.error());
        const std::string text = morph_text(plan_, number_text(plan_.blend.a0));
        if (options_.output == "-") return print_result(text);
        const WritingFile guard;
        if (const Status status = write_file(*options_.output, text); !status) return fail(status.error());
        print_summary(fmt::format("metamorphosis to {}: time {}..{}, a0 = {}", *options_.output,
                                  number_text(plan_.from), number_text(plan_.to),
                                  number_text(plan_.blend.a0)));
        return exit_ok;
    }

  private:
    Status read_numbers() {
        struct Row {
            const std::optional<std::string>& text;
            double& value;
            const char* option;
        };
        for (const Row& row :
             {Row{options_.a0, plan_.blend.a0, "--a0"}, Row{options_.a1, plan_.blend.a1, "--a1"},
              Row{options_.a2, plan_.blend.a2, "--a2"}, Row{options_.a3, plan_.blend.a3, "--a3"},
              Row{options_.b0, plan_.blend.b0, "--b0"},
              Row{options_.smoothing, plan_.blend.c, "--smoothing"}}) {
            if (!row.text) continue;
            const auto value = parse_number(*row.text);
            if (!value || !std::isfinite(*value))
                return usage(fmt::format("{}: `{}` is not a finite number", row.option, *row.text));
            row.value = *value;
        }
        if (!(plan_.blend.c > 0 && plan_.blend.c <= MorphBlend::span))
            return usage(fmt::format("--smoothing: the time must lie in 0..{}", MorphBlend::span));
        if (!options_.time) return {};
        const auto range = parse_along("t=" + *options_.time);
        if (!range) return usage(fmt::format("--time: `{}` is not of the form A..B", *options_.time));
        if (!(range->from < range->to)) return usage("--time: the end must lie after the beginning");
        plan_.from = range->from;
        plan_.to = range->to;
        return {};
    }

    Status check_models() {
        const int n = plan_.parts[0]->header().coordinates();
        for (const PreparedModel* part : plan_.parts)
            if (part->model.text_form() != ModelText::hyperfun)
                return usage(fmt::format("'{}' is not a HyperFun file", part->model.source().name()));
        if (n != plan_.parts[1]->header().coordinates() || n < 2 || n > 3)
            return usage(fmt::format("the models have {} and {} coordinates; both must have 2, or both 3", n,
                                     plan_.parts[1]->header().coordinates()));
        if (plan_.parts[0]->model.program().annotations.set_operations !=
            plan_.parts[1]->model.program().annotations.set_operations)
            return usage("the models have different --@ set-operations; one file can have one system only");
        if (plan_.parameter_count() >= max_parameters)  // the search for a0 needs one more
            return Error{ErrorKind::over_limit, fmt::format("more than {} parameters", max_parameters - 1)};
        return {};
    }

    /// The box around both shapes, and what their values are multiplied by, so that the same blend suits
    /// shapes of any size and functions of any slope: slope times size becomes usual_range. Three digits are
    /// enough, and read better.
    Status find_range() {
        std::array<double, 2> slopes{1, 1};
        for (std::size_t i = 0; i < 2; ++i) {
            const PreparedModel& part = *plan_.parts[i];
            const auto field = sampled_field(part);
            if (!field) return field.error();
            auto box = choose_box(part, {}, **field, job_);
            if (!box) return box.error();
            if (plan_.coordinates() == 2) box->min.z = box->max.z = 0;
            if (const auto slope = surface_slope(**field, *box)) slopes[i] = slope->median;
            plan_.box = i == 0 ? *box : joined(plan_.box, *box);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            const double factor = rounded(usual_range / (slopes[i] * plan_.box.diagonal()), 3);
            if (std::isfinite(factor) && factor > 0) plan_.factors[i] = factor;
        }
        return {};
    }

    /// The smallest displacement, to a tenth or so, with which no frame is much smaller than the shapes, and
    /// none falls into more parts than they have.
    Status find_strength() {
        Box3 box = plan_.box;
        const double margin = 0.1 * box.diagonal();
        box.min = box.min - Vec3{margin, margin, margin};
        box.max = box.max + Vec3{margin, margin, margin};
        if (plan_.coordinates() == 2) box.min.z = box.max.z = 0;  // the margin's
        // One model for all trials: a0 is a parameter of it, the last one.
        const std::size_t last = plan_.parameter_count();
        const Model model(Source("morph.hf", morph_text(plan_, fmt::format("a[{}]", last + 1))));
        const auto object = model.find_object("my_model");
        if (!model.ok() || !object) return usage("the two models cannot be put into one file");
        std::vector<double> values = parameters();
        values.resize(last + 1);
        Diagnostics found;
        auto lowered = model.lower(*object, values, found);
        if (!lowered) {
            print_diagnostics(found, model.source());
            return Error{ErrorKind::invalid_model, "the two models cannot be put into one file"};
        }
        PreparedModel trial{model,
                            *object,
                            std::move(*lowered),
                            plan_.parts[0]->evaluator,
                            plan_.parts[0]->engine,
                            AxisMap::standard(static_cast<int>(plan_.coordinates()) + 1),
                            false,
                            job_.threads};
        auto strength = MovingModel::make(trial, Along{fmt::format("a[{}]", last + 1), 0, 1});
        if (!strength) return strength.error();
        ProgressBar bar("looking for a0");
        double least = -1;
        const auto try_strength = [&](double a0) -> Result<double> {
            if (const Status status = strength->set(a0); !status) return status.error();
            return try_out(trial, box);
        };
        for (int step = 0; step < doublings && least != 0; ++step) {
            const double a0 = usual_range / 64 * (1 << step);
            const auto badness = try_strength(a0);
            if (!badness) return badness.error();
            bar.update((step + 1.0) / (doublings + halvings));
            if (least >= 0 && *badness >= least) continue;
            least = *badness;
            plan_.blend.a0 = a0;
        }
        // More than needed puffs the shapes up.
        double too_small = plan_.blend.a0 / 2;
        for (int step = 0; step < halvings && least == 0; ++step) {
            const double a0 = rounded(std::sqrt(too_small * plan_.blend.a0), 2);
            const auto badness = try_strength(a0);
            if (!badness) return badness.error();
            bar.update((doublings + step + 1.0) / (doublings + halvings));
            (*badness == 0 ? plan_.blend.a0 : too_small) = a0;
        }
        if (least > 0)
            print_warning("the shapes fall apart or vanish between: try --a0, --b0, or move them nearer");
        return {};
    }

    /// 0 where all is well: a frame that is smaller than a share of the smaller shape counts up to 10, each
    /// part too many 1.
    Result<double> try_out(PreparedModel& trial, const Box3& box) {
        const Along along{fmt::format("x{}", plan_.coordinates() + 1), plan_.from, plan_.to};
        auto moving = MovingModel::make(trial, along);
        if (!moving) return moving.error();
        const auto frames =
            measure_frames(*moving, evenly_spaced(along, trial_frames), box, 0,
                           plan_.coordinates() == 2 ? trial_cells_flat : trial_cells_solid, job_);
        if (!frames) return frames.error();
        const int most = std::max({1, frames->front().components, frames->back().components});
        const double floor = least_share * std::min(frames->front().size, frames->back().size);
        double bad = 0;
        for (const FrameMeasure& m : *frames) {
            bad += std::max(0, m.components - most);
            if (m.size < floor) bad += 10 * (1 - m.size / floor);
        }
        return bad;
    }

    std::vector<double> parameters() const {
        std::vector<double> out;
        for (const PreparedModel* part : plan_.parts)
            for (int i = 0; i < part->header().parameters(); ++i)
                out.push_back(part->field().parameters[static_cast<std::size_t>(i)]);
        return out;
    }

    const MorphOptions& options_;
    MorphPlan plan_;
    Job job_;
};

}  // namespace

int run_morph(Arguments arguments) {
    MorphOptions options;
    std::string second;
    CommandLine line("morph", "morph A.hf B.hf -o AB.hf [options]",
                     "Makes a model in which shape A turns into shape B; its last coordinate is time.",
                     {"frep morph disk.hf square.hf -o disk-to-square.hf",
                      "frep morph cup.hf pot.hf -o cup-to-pot.hf --time 0..1",
                      "frep morph a.hf b.hf -o - --a0 8 --b0 -0.3"});
    declare_model_options(line, options.first);
    line.positional("SECOND", options.second.input, "HyperFun file of the shape at the end");
    line.text("-o,--output", options.output, "FILE.hf", "the model; - for standard output");
    line.text("--time", options.time, "A..B", "time of the first and of the second shape (default -10..10)");
    line.text("--second-object", options.second.object, "NAME", "object of the second model");
    line.text("--a0", options.a0, "V", "strength of the blend (default: found, so that no frame is empty)");
    line.text("--a1", options.a1, "V", "extent along the first shape (default 2)");
    line.text("--a2", options.a2, "V", "extent along the second shape (default 2)");
    line.text("--a3", options.a3, "V", "weight of the span of time (default 1)");
    line.text("--b0", options.b0, "V", "smoothing of the half-cylinders, < 0 (default -0.5)");
    line.text("--smoothing", options.smoothing, "T", "time from -T to T is smoothed (default 5, of 10)");
    line.flag("--plain", options.plain, "half-cylinders with flat ends: a rapid transition");
    if (const auto code = line.parse(arguments)) return *code;
    if (!options.output) return usage_error("-o FILE is missing: where the model goes (.hf)");
    if (options.second.input.empty()) return usage_error("the second model is missing");
    int code = exit_ok;
    auto first = prepare_model(options.first, code);
    if (!first) return code;
    options.second.threads = options.first.threads;
    options.second.engine = options.first.engine;
    auto other = prepare_model(options.second, code);
    if (!other) return code;
    return MorphRun(options, *first, *other).run();
}

}  // namespace frep::cli
