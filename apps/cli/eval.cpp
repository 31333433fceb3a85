// `frep eval`: F and the attributes at points, gradients, or enclosures over boxes, from a stream of lines.
// Tested by tests/cli/eval.txt and its neighbours.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "batch.h"
#include "command_line.h"
#include "input_stream.h"
#include "model_input.h"
#include "point_lines.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

struct EvalOptions {
    ModelOptions model;
    std::optional<std::string> points, intervals, bounds, tolerance;
    bool gradient = false, classify = false;
};

constexpr std::size_t batch_size = 16384;
/// Of --classify, model units.
constexpr double default_tolerance = 1e-6;

/// Reads lines, evaluates them in batches and prints a line for each.
class Session {
  public:
    Session(const PreparedModel& prepared, Wanted wanted, std::unique_ptr<Evaluator> evaluator,
            double tolerance)
        : prepared_(prepared),
          boxes_(wanted == Wanted::intervals),
          evaluator_(std::move(evaluator), wanted, prepared.threads, {tolerance, moving(prepared)}) {
        columns_.resize(prepared.map.coordinates.size() * numbers_a_coordinate());
        for (std::size_t i = 0; i < prepared.map.coordinates.size(); ++i) {
            const MappedCoordinate& c = prepared.map.coordinates[i];
            sources_.push_back(!prepared.map_given ? static_cast<int>(i) : c.axis);
            expected_ = std::max(expected_, static_cast<std::size_t>(sources_.back() + 1));
        }
    }

    int run(LineReader& reader) {
        while (true) {
            const auto more = reader.read_block();
            if (!more) return fail(more.error());
            if (!*more) break;
            if (const int code = take_lines(reader)) return code;
            if (const int code = flush()) return code;
        }
        warn();
        return exit_ok;
    }

  private:
    /// The coordinates that lines of points can change.
    static std::vector<bool> moving(const PreparedModel& prepared) {
        std::vector<bool> out;
        for (const MappedCoordinate& c : prepared.map.coordinates)
            out.push_back(!prepared.map_given || c.axis >= 0);
        return out;
    }

    std::size_t numbers_a_coordinate() const { return boxes_ ? 2 : 1; }

    int take_lines(LineReader& reader) {
        std::string_view line;
        while (reader.next_line(line)) {
            if (boxes_) {
                parse_box(line, content_);
            } else {
                parse_point(line, content_);
            }
            if (!content_.error.empty()) {
                if (const int code = flush()) return code;
                return fail({ErrorKind::io, fmt::format("{}:{}:{}: {}", reader.name(), reader.line_number(),
                                                        content_.column, content_.error)});
            }
            // Without coordinates an empty line is a point like any other.
            if (content_.is_comment || (content_.is_blank && expected_ > 0)) continue;
            add(reader.line_number());
            if (lines_.size() == batch_size)
                if (const int code = flush()) return code;
        }
        return exit_ok;
    }

    void add(std::uint64_t line) {
        const std::size_t width = numbers_a_coordinate();
        const std::size_t given = content_.numbers.size() / width;
        if (given > expected_ && first_long_ == 0) first_long_ = line;
        if (given < expected_ && first_short_ == 0) first_short_ = line;
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            const auto source = static_cast<std::size_t>(sources_[i]);
            for (std::size_t k = 0; k < width; ++k) {
                double value = 0;
                if (sources_[i] < 0) value = prepared_.map.coordinates[i].value;
                if (sources_[i] >= 0 && source < given) value = content_.numbers[source * width + k];
                columns_[i * width + k].push_back(value);
            }
        }
        lines_.push_back(line);
    }

    int flush() {
        if (lines_.empty()) return exit_ok;
        const BatchResult result = evaluator_.run(columns_, lines_.size());
        if (result.first && undefined_ == 0) {
            first_line_ = lines_[result.first->point];
            first_output_ = result.first->output;
            for (const auto& column : columns_) first_point_.push_back(column[result.first->point]);
        }
        undefined_ += result.undefined;
        points_ += lines_.size();
        for (auto& column : columns_) column.clear();
        lines_.clear();
        return print_result(result.text);
    }

    void warn() const {
        if (undefined_ > 0) {
            const NodeId root = prepared_.field().roots()[first_output_];
            const std::string what = first_output_ == 0 ? "F" : fmt::format("s[{}]", first_output_);
            warn_undefined(prepared_, root, first_point_,
                           fmt::format("undefined values at {} of {} points, first {} on line {}, at {}",
                                       undefined_, points_, what, first_line_, point_text(first_point_)));
        }
        if (first_long_ == 0 && first_short_ == 0) return;
        std::string text = fmt::format("not all lines have {} coordinates:", expected_);
        if (first_long_ > 0) text += fmt::format(" extra ones are ignored (first on line {})", first_long_);
        if (first_long_ > 0 && first_short_ > 0) text += ",";
        if (first_short_ > 0) text += fmt::format(" missing ones are 0 (first on line {})", first_short_);
        print_warning(text);
    }

    const PreparedModel& prepared_;
    bool boxes_;
    BatchEvaluator evaluator_;
    std::vector<int> sources_;  ///< for each coordinate of the model its place in the line; -1: frozen
    std::size_t expected_ = 0;  ///< coordinates in a line
    LineContent content_;
    Columns columns_;
    std::vector<std::uint64_t> lines_;  ///< line number of each point of the batch

    std::uint64_t points_ = 0, undefined_ = 0;
    std::uint64_t first_line_ = 0, first_long_ = 0, first_short_ = 0;
    std::size_t first_output_ = 0;
    std::vector<double> first_point_;
};

/// What is wrong with the options, taken together.
std::string contradiction(const EvalOptions& options) {
    if (options.points && options.intervals) return "give either --points or --intervals";
    if (!options.points && !options.intervals)
        return "give --points FILE or --intervals FILE (- for standard input)";
    if (options.gradient && options.intervals) return "--gradient needs --points";
    if (options.classify && options.intervals) return "--classify needs --points";
    if (options.classify && options.gradient) return "give either --classify or --gradient";
    if (options.tolerance && !options.classify) return "--tolerance needs --classify";
    if (options.model.input == "-" && options.points.value_or(options.intervals.value_or("")) == "-")
        return "the model and the points cannot both come from standard input";
    return {};
}

int evaluate(const EvalOptions& options) {
    if (const std::string wrong = contradiction(options); !wrong.empty()) return usage_error(wrong);
    if (options.bounds) {
        if (const auto box = parse_bounds(*options.bounds); !box)
            return usage_error("--bounds: " + box.error().message);
        print_warning("--bounds has no effect on eval");
    }
    double tolerance = default_tolerance;
    if (options.tolerance) {
        const auto given = parse_positive(*options.tolerance);
        if (!given) return usage_error("--tolerance: " + given.error().message);
        tolerance = *given;
    }
    int code = exit_ok;
    auto prepared = prepare_model(options.model, code);
    if (!prepared) return code;
    prepared->evaluator.attributes =
        prepared->header().declares_attributes && !options.intervals && !options.classify;
    auto evaluator = make_evaluator(prepared->field(), prepared->evaluator);
    if (!evaluator) return fail(evaluator.error());
    LineReader reader(options.intervals ? *options.intervals : *options.points);
    if (!reader.status()) return fail(reader.status().error());
    const Wanted wanted = options.intervals  ? Wanted::intervals
                          : options.classify ? Wanted::classes
                          : options.gradient ? Wanted::gradients
                                             : Wanted::values;
    return Session(*prepared, wanted, std::move(*evaluator), tolerance).run(reader);
}

}  // namespace

int run_eval(Arguments arguments) {
    EvalOptions options;
    CommandLine line("eval", "eval MODEL --points FILE|- [options]",
                     "Prints F at every point, and the attributes if the object's header declares s.",
                     {"echo 0 0 1 | frep eval pot.hf --points -",
                      "frep eval pot.hf --points points.txt --gradient > values.txt",
                      "echo -1,1 0,2 0,0 | frep eval pot.hf --intervals -"});
    declare_model_options(line, options.model);
    line.text("--points", options.points, "FILE", "points, one a line, separated by blanks or commas");
    line.text("--intervals", options.intervals, "FILE", "boxes, one a line: lo,hi for every coordinate");
    line.flag("--gradient", options.gradient, "also print the partial derivatives of F");
    line.flag("--classify", options.classify, "print in, on or out for every point, and nothing else");
    line.text("--tolerance", options.tolerance, "LENGTH",
              "a point is on the surface where |F| <= LENGTH |grad F| (default 1e-6)");
    line.text("--bounds", options.bounds, "BOX", "without effect here");
    if (const auto code = line.parse(arguments)) return *code;
    return evaluate(options);
}

}  // namespace frep::cli
