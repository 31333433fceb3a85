// From the options that the evaluating verbs share to a field that is ready to be evaluated: reading the
// model, choosing the object, its parameters, the engine and the map of coordinates. Everything that goes
// wrong is printed here. Tested by tests/cli.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command_line.h"
#include "frep/frep.h"

namespace frep::cli {

/// Reads and parses the model `path` (`-`: standard input). With errors in the text, or when it cannot be
/// read, they are printed, `code` is set and nothing comes back; warnings are left to the caller.
std::optional<Model> load_model(const std::string& path, int& code);

/// As load_model(), without printing the findings: for `frep check`.
std::optional<Model> read_model(const std::string& path, int& code);

/// The object called `name` (empty: the default one); an unknown name is printed, with `code` 2.
std::optional<std::size_t> choose_object(const Model& model, std::string_view name, int& code);

/// Options of the verbs that evaluate a model, as given.
struct ModelOptions {
    std::string input;
    std::optional<std::string> object, values, engine, map, max_steps, threads;
    std::vector<std::string> named_values;
    bool no_lift = false;
};
void declare_model_options(CommandLine& line, ModelOptions& options);

/// What they mean.
struct PreparedModel {
    Model model;
    std::size_t object = 0;
    lang::Lowered lowered;
    EvaluatorOptions evaluator;
    std::string_view engine;
    AxisMap map;
    bool map_given = false;
    int threads = 1;
    /// Coordinates that --map gives the value of a parameter: coordinate, parameter (both from 0).
    std::vector<std::pair<std::size_t, std::size_t>> tied = {};

    const lang::Object& header() const { return model.program().objects[object]; }
    const Field& field() const { return lowered.field; }
};

/// Reads everything and prints the model's findings. Nothing when something is wrong; `code` is then set.
std::optional<PreparedModel> prepare_model(const ModelOptions& options, int& code);

/// F - iso of the prepared model in space; with `attributes` the object's attributes too, which only
/// SampledField::attributes() evaluates. Errors: as of make_evaluator and make_sampled_field.
Result<std::unique_ptr<SampledField>> sampled_field(const PreparedModel& prepared, double iso = 0,
                                                    bool attributes = false);

/// True when the object has the three attributes s[1..3] that are its color.
bool has_colors(const PreparedModel& prepared);

/// The model's own color, `--@ color`.
std::optional<Color> annotated_color(const Model& model);

/// The last axis of space that no coordinate takes: a model with one is flat, across it. Nothing for a solid.
std::optional<int> unused_axis(const PreparedModel& prepared);

/// The name of a coordinate, first = 0: "x", "y", "z", "t", "x5".
std::string coordinate_name(std::size_t index);
/// The number, from 0, of the coordinate that a name in lower case means, of so many: that name, or "x1", or
/// "x[1]".
std::optional<std::size_t> find_coordinate(std::string_view name, std::size_t count);
/// The same for "t" where no coordinate is called so: the last of three, time in a plane model that moves.
std::optional<std::size_t> find_time(std::string_view name, std::size_t count);

/// The number, from 0, of the parameter that a name means.
using FindParameter = std::function<std::optional<std::size_t>(std::string_view)>;

/// What `--map` says.
struct StatedMap {
    AxisMap map;
    std::vector<std::pair<std::size_t, std::size_t>> tied;  ///< see PreparedModel
};
/// The map that `text` means for `count` coordinates: entries for all (an axis, a number or a parameter's
/// name), or NAME=V only, V a number or a parameter's name.
Result<StatedMap> parse_map(std::string_view text, std::size_t count, const FindParameter& find = {});

/// A warning: `message`, and the place in the model's text where `root` begins to be undefined at `point`.
void warn_undefined(const PreparedModel& prepared, NodeId root, std::span<const double> point,
                    const std::string& message);

/// "(1, 2.5, -3)".
std::string point_text(std::span<const double> point);

}  // namespace frep::cli
