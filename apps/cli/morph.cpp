// `frep morph`: two models become one with time as its last coordinate, by space-time bounded blending, as a
// readable HyperFun file. Tested by tests/cli/morph.txt.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "box.h"
#include "budget.h"
#include "command_line.h"
#include "frame_report.h"
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

/// Numbers of the blend, for time from -10 to 10 and shapes whose values run through about 8 units.
struct Blend {
    double a0 = 0, a1 = 2, a2 = 2, a3 = 1, b0 = -0.5, c = 5;
};

constexpr double usual_range = 8;
constexpr double span = 10;  ///< the blend's own time runs from -span to span
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
        : options_(options), parts_{&first, &second} {
        job_.threads = first.threads;
    }

    int run() {
        if (const Status status = read_numbers(); !status) return fail(status.error());
        if (const Status status = check_models(); !status) return fail(status.error());
        for (std::size_t i = 0; i < 2; ++i) {
            const auto field = sampled_field(*parts_[i]);
            if (!field) return fail(field.error());
            const auto box = choose_box(*parts_[i], {}, **field, job_);
            if (!box) return fail(box.error());
            boxes_[i] = *box;
            if (coordinates_ == 2) boxes_[i].min.z = boxes_[i].max.z = 0;
            if (const auto slope = surface_slope(**field, boxes_[i])) slopes_[i] = slope->median;
        }
        find_factors();
        if (!options_.a0)
            if (const Status status = find_strength(); !status) return fail(status.error());
        const std::string text = model_text(number_text(blend_.a0));
        if (options_.output == "-") return print_result(text);
        const WritingFile guard;
        if (const Status status = write_file(*options_.output, text); !status) return fail(status.error());
        print_summary(fmt::format("metamorphosis to {}: time {}..{}, a0 = {}", *options_.output,
                                  number_text(from_), number_text(to_), number_text(blend_.a0)));
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
             {Row{options_.a0, blend_.a0, "--a0"}, Row{options_.a1, blend_.a1, "--a1"},
              Row{options_.a2, blend_.a2, "--a2"}, Row{options_.a3, blend_.a3, "--a3"},
              Row{options_.b0, blend_.b0, "--b0"}, Row{options_.smoothing, blend_.c, "--smoothing"}}) {
            if (!row.text) continue;
            const auto value = parse_number(*row.text);
            if (!value || !std::isfinite(*value))
                return usage(fmt::format("{}: `{}` is not a finite number", row.option, *row.text));
            row.value = *value;
        }
        if (!(blend_.c > 0 && blend_.c <= span))
            return usage(fmt::format("--smoothing: the time must lie in 0..{}", span));
        if (!options_.time) return {};
        const auto range = parse_along("t=" + *options_.time);
        if (!range) return usage(fmt::format("--time: `{}` is not of the form A..B", *options_.time));
        if (!(range->from < range->to)) return usage("--time: the end must lie after the beginning");
        from_ = range->from;
        to_ = range->to;
        return {};
    }

    Status check_models() {
        const int n = parts_[0]->header().coordinates();
        for (const PreparedModel* part : parts_)
            if (part->model.text_form() != ModelText::hyperfun)
                return usage(fmt::format("'{}' is not a HyperFun file", part->model.source().name()));
        if (n != parts_[1]->header().coordinates() || n < 2 || n > 3)
            return usage(fmt::format("the models have {} and {} coordinates; both must have 2, or both 3", n,
                                     parts_[1]->header().coordinates()));
        if (parts_[0]->model.program().annotations.set_operations !=
            parts_[1]->model.program().annotations.set_operations)
            return usage("the models have different --@ set-operations; one file can have one system only");
        if (own_parameters() >= max_parameters)  // the search for a0 needs one more
            return Error{ErrorKind::over_limit, fmt::format("more than {} parameters", max_parameters - 1)};
        coordinates_ = static_cast<std::size_t>(n);
        return {};
    }

    Box3 both() const { return joined(boxes_[0], boxes_[1]); }

    /// What the values of the shapes are multiplied by, so that the same blend suits shapes of any size and
    /// functions of any slope: slope times size becomes usual_range. Three digits are enough, and read
    /// better.
    void find_factors() {
        for (std::size_t i = 0; i < 2; ++i) {
            const double range = slopes_[i] * both().diagonal();
            const double factor = rounded(usual_range / range, 3);
            if (std::isfinite(factor) && factor > 0) factors_[i] = factor;
        }
    }

    /// The smallest displacement, to a tenth or so, with which no frame is much smaller than the shapes, and
    /// none falls into more parts than they have.
    Status find_strength() {
        Box3 box = both();
        const double margin = 0.1 * box.diagonal();
        box.min = box.min - Vec3{margin, margin, margin};
        box.max = box.max + Vec3{margin, margin, margin};
        if (coordinates_ == 2) box.min.z = box.max.z = 0;  // the margin's
        // One model for all trials: a0 is a parameter of it, the last one.
        const std::size_t last = own_parameters();
        const Model model(Source("morph.hf", model_text(fmt::format("a[{}]", last + 1))));
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
                            parts_[0]->evaluator,
                            parts_[0]->engine,
                            AxisMap::standard(static_cast<int>(coordinates_) + 1),
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
            blend_.a0 = a0;
        }
        // More than needed puffs the shapes up.
        double too_small = blend_.a0 / 2;
        for (int step = 0; step < halvings && least == 0; ++step) {
            const double a0 = rounded(std::sqrt(too_small * blend_.a0), 2);
            const auto badness = try_strength(a0);
            if (!badness) return badness.error();
            bar.update((doublings + step + 1.0) / (doublings + halvings));
            (*badness == 0 ? blend_.a0 : too_small) = a0;
        }
        if (least > 0)
            print_warning("the shapes fall apart or vanish between: try --a0, --b0, or move them nearer");
        return {};
    }

    /// 0 where all is well: a frame that is smaller than a share of the smaller shape counts up to 10, each
    /// part too many 1.
    Result<double> try_out(PreparedModel& trial, const Box3& box) {
        const Along along{fmt::format("x{}", coordinates_ + 1), from_, to_};
        auto moving = MovingModel::make(trial, along);
        if (!moving) return moving.error();
        const auto frames = measure_frames(*moving, evenly_spaced(along, trial_frames), box, 0,
                                           coordinates_ == 2 ? trial_cells_flat : trial_cells_solid, job_);
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

    /// How many parameters the two models have.
    std::size_t own_parameters() const {
        return static_cast<std::size_t>(parts_[0]->header().parameters() + parts_[1]->header().parameters());
    }

    std::vector<double> parameters() const {
        std::vector<double> out;
        for (const PreparedModel* part : parts_)
            for (int i = 0; i < part->header().parameters(); ++i)
                out.push_back(part->field().parameters[static_cast<std::size_t>(i)]);
        return out;
    }

    /// `--@ param` lines for the parameters of both, named after the model, with the values used here.
    std::string parameter_lines() const {
        std::string out;
        std::size_t index = 1;
        for (std::size_t k = 0; k < 2; ++k) {
            const PreparedModel& part = *parts_[k];
            for (int i = 0; i < part.header().parameters(); ++i, ++index) {
                const double value = part.field().parameters[static_cast<std::size_t>(i)];
                const lang::ParameterAnnotation* note = nullptr;
                if (part.model.find_object({}) == part.object)
                    for (const auto& row : part.model.program().annotations.parameters)
                        if (row.index == i + 1) note = &row;
                if (!note && value == 0) continue;
                out += fmt::format("--@ param a[{}] {}{}", index, prefixes[k],
                                   note ? note->name : fmt::format("a{}", i + 1));
                if (note && note->has_range && value >= note->low && value <= note->high)
                    out += fmt::format(" {}..{}", number_text(note->low), number_text(note->high));
                out += fmt::format(" default {}", number_text(value));
                if (note && !note->description.empty()) out += fmt::format(" \"{}\"", note->description);
                out += "\n";
            }
        }
        return out;
    }

    /// Assignments that fill `array` with items of `from`, beginning after `skip`.
    static std::string copied(const std::string& array, const std::string& from, std::size_t count,
                              std::size_t skip) {
        std::string out;
        for (std::size_t i = 1; i <= count; ++i)
            out += fmt::format("  {}[{}] = {}[{}];\n", array, i, from, i + skip);
        return out;
    }

    static std::string system_line(const shapes::SetSystem& system) {
        using Kind = shapes::SetSystem::Kind;
        switch (system.kind) {
            case Kind::r0:
                break;
            case Kind::min_max:
                return "--@ set-operations min-max\n";
            case Kind::r_alpha:
                return fmt::format("--@ set-operations r-alpha {}\n", number_text(system.parameter));
            case Kind::r0m:
                return fmt::format("--@ set-operations r0m {}\n", number_text(system.parameter));
            case Kind::rp:
                return fmt::format("--@ set-operations rp {}\n", number_text(system.parameter));
        }
        return {};
    }

    std::string header() const {
        const auto title = [](const PreparedModel& part) {
            const std::string& given = part.model.program().annotations.title;
            return given.empty() ? part.header().written_name : given;
        };
        const Box3 box = both();
        const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
        std::string out =
            fmt::format("--@ title    {} to {}\n--@ bounds  ", title(*parts_[0]), title(*parts_[1]));
        for (std::size_t a = 0; a < coordinates_; ++a) {
            const double margin = 0.1 * (high[a] - low[a]);
            out += fmt::format(" {:.4g} {:.4g} ", low[a] - margin, high[a] + margin);
        }
        out += fmt::format(" {} {}\n", number_text(from_), number_text(to_));
        out += system_line(parts_[0]->model.program().annotations.set_operations);
        out += parameter_lines();
        return out +
               "-- Space-time bounded blending of two models; the last coordinate is time. Made by frep "
               "morph.\n\n";
    }

    /// The color of both, if they have any: from their attributes, or from their annotations.
    bool is_colored() const {
        return std::all_of(std::begin(parts_), std::end(parts_), [](const PreparedModel* part) {
            return has_colors(*part) || annotated_color(part->model);
        });
    }
    std::string color_text(std::size_t k) const {
        if (has_colors(*parts_[k])) return {};
        const Color color = *annotated_color(parts_[k]->model);
        return fmt::format("  c{}[1] = {};\n  c{}[2] = {};\n  c{}[3] = {};\n", k + 1, number_text(color.r),
                           k + 1, number_text(color.g), k + 1, number_text(color.b));
    }

    /// The model; `a0` is a number or a parameter.
    std::string model_text(const std::string& a0) const {
        const Blend& b = blend_;
        const std::size_t n = coordinates_;
        const std::size_t counts[2] = {static_cast<std::size_t>(parts_[0]->header().parameters()),
                                       static_cast<std::size_t>(parts_[1]->header().parameters())};
        std::string out = header();
        for (std::size_t k = 0; k < 2; ++k) {
            const Model& model = parts_[k]->model;
            out += fmt::format("-- Objects of the {} model.\n", k == 0 ? "first" : "second");
            out += lang::with_renamed_objects(model.source(), model.program(), prefixes[k]);
            out += "\n\n";
        }
        const bool colored = is_colored();
        out += fmt::format("my_model(x[{}], a[{}]{})\n{{\n", n + 1,
                           std::max<std::size_t>(1, own_parameters() + (a0.starts_with('a') ? 1 : 0)),
                           colored ? ", s[3]" : "");
        out += fmt::format("  array p[{}], u[{}], v[{}]{};\n", n, std::max<std::size_t>(1, counts[0]),
                           std::max<std::size_t>(1, counts[1]), colored ? attribute_arrays() : "");
        out +=
            copied("p", "x", n, 0) + copied("u", "a", counts[0], 0) + copied("v", "a", counts[1], counts[0]);
        if (counts[0] == 0) out += "  u[1] = 0;\n";
        if (counts[1] == 0) out += "  v[1] = 0;\n";
        for (std::size_t k = 0; k < 2; ++k) out += call_text(k, colored);
        out += time_text(n + 1);
        if (colored) out += blended_colors();
        out += options_.plain
                   ? fmt::format("  my_model = hfSpaceTimeBlend(g1, g2, t, 0, 1, 10, {}, {}, {}, {});\n}}\n",
                                 a0, number_text(b.a1), number_text(b.a2), number_text(b.a3))
                   : fmt::format(
                         "  my_model = hfSpaceTimeBlendSmooth(g1, g2, t, 0, 1, 10, {}, {}, {}, {}, {}, "
                         "{});\n}}\n",
                         a0, number_text(b.a1), number_text(b.a2), number_text(b.a3), number_text(b.b0),
                         number_text(b.c));
        return out;
    }

    /// The blend's time, from -10 to 10.
    std::string time_text(std::size_t index) const {
        const double middle = 0.5 * (from_ + to_), scale = 2 * span / (to_ - from_);
        std::string time = fmt::format("x[{}]", index);
        if (middle != 0)
            time = fmt::format("({} {} {})", time, middle > 0 ? "-" : "+", number_text(std::abs(middle)));
        if (scale != 1) time = fmt::format("{}*{}", number_text(scale), time);
        return fmt::format("  t = {};\n", time);
    }

    std::string attribute_arrays() const {
        std::string out;
        for (std::size_t k = 0; k < 2; ++k)
            out += fmt::format(", c{}[{}]", k + 1,
                               std::max<std::size_t>(3, parts_[k]->field().attributes.size()));
        return out;
    }
    /// g1 = 0.5*first_name(p, u); with attributes the three of the color.
    std::string call_text(std::size_t k, bool colored) const {
        const char* const values = k == 0 ? "u" : "v";
        const std::string name = std::string(prefixes[k]) + parts_[k]->header().written_name;
        std::string out;
        const bool with_colors = colored && has_colors(*parts_[k]);
        if (with_colors)
            for (std::size_t i = 1; i <= parts_[k]->field().attributes.size(); ++i)
                out += fmt::format("  c{}[{}] = 0;\n", k + 1, i);
        if (colored) out += color_text(k);
        const std::string factor = factors_[k] == 1 ? "" : number_text(factors_[k]) + "*";
        return out + fmt::format("  g{} = {}{}(p, {}{});\n", k + 1, factor, name, values,
                                 with_colors ? fmt::format(", c{}", k + 1) : "");
    }
    static std::string blended_colors() {
        return "  f1 = hfHalfCylinderBefore(g1, t, 0);\n"
               "  f2 = hfHalfCylinderAfter(g2, t, 1);\n"
               "  mixed = hfA_SpaceTimeColor(f1, f2, s, c1, c2);\n";
    }

    static constexpr const char* prefixes[2] = {"first_", "second_"};
    const MorphOptions& options_;
    const PreparedModel* parts_[2];
    Box3 boxes_[2];
    double slopes_[2] = {1, 1}, factors_[2] = {1, 1};
    Job job_;
    Blend blend_;
    double from_ = -10, to_ = 10;
    std::size_t coordinates_ = 3;
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
