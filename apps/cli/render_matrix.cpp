// Implementation of render_matrix.h.
#include "render_matrix.h"

#include <fmt/format.h>

#include "moving_view.h"
#include "picture_file.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace frep::cli {

namespace {

/// One row of states is broken into several when it is longer.
constexpr int longest_row = 6;

/// A state: the value of each thing that moves.
using State = std::vector<double>;

std::vector<State> states_of(const MatrixPlan& matrix) {
    std::vector<State> out{{}};
    for (std::size_t k = matrix.steps.size(); k-- > 0;) {  // the last runs slowest: down
        std::vector<State> longer;
        for (const State& state : out)
            for (const double value : evenly_spaced(matrix.steps[k].along, matrix.steps[k].count)) {
                longer.push_back(state);
                longer.back().insert(longer.back().begin(), value);
            }
        out = std::move(longer);
    }
    return out;
}

int columns_of(const MatrixPlan& matrix) {
    const int count = matrix.steps[0].count;
    if (matrix.steps.size() > 1 || count <= longest_row) return count;
    int rows = 2;
    while ((count + rows - 1) / rows > longest_row) ++rows;
    return (count + rows - 1) / rows;
}

class MatrixRun {
  public:
    /// The model is in one of the states: a coordinate that moves is no axis of the picture.
    MatrixRun(const RenderOptionTexts& options, const RenderPlan& plan, const MatrixPlan& matrix,
              PreparedModel& prepared, std::vector<MovingModel> moving)
        : options_(options),
          matrix_(matrix),
          prepared_(prepared),
          view_(options, plan, prepared),
          moving_(std::move(moving)) {}

    int run() {
        if (const auto code = view_.begin()) return *code;
        const std::vector<State> states = states_of(matrix_);
        for (const State& state : states) {
            if (const Status status = set(state); !status) return fail(status.error());
            if (const Status status = view_.include(); !status) return fail(status.error());
        }
        const auto tiles = make_tiles(states);
        if (!tiles) return fail(tiles.error());
        const auto image = mosaic(*tiles, {.columns = columns_of(matrix_)});
        if (!image) return fail(image.error());
        if (const int code = write_picture(*image, prepared_.model, *options_.output)) return code;
        print_summary(fmt::format(
            "{} views, {} x {} pixels, to {} in {:.2f} s", states.size(), image->width, image->height,
            *options_.output == "-" ? "standard output" : *options_.output, now_seconds() - start_));
        return exit_ok;
    }

  private:
    Status set(const State& state) {
        for (std::size_t k = 0; k < moving_.size(); ++k)
            if (const Status status = moving_[k].set(state[k]); !status) return status;
        view_.changed();
        return {};
    }

    std::string caption(const State& state) const {
        std::string out;
        for (std::size_t k = 0; k < moving_.size(); ++k)
            out += fmt::format("{}{} = {:.6g}", k ? ", " : "", moving_[k].name(), state[k]);
        return out;
    }

    Result<std::vector<MosaicTile>> make_tiles(const std::vector<State>& states) {
        ProgressBar bar("rendering");
        std::vector<MosaicTile> tiles;
        for (const State& state : states) {
            if (const Status status = set(state); !status) return status.error();
            auto image = view_.picture();
            if (!image) return image.error();
            tiles.push_back({std::move(*image), caption(state)});
            bar.update(static_cast<double>(tiles.size()) / static_cast<double>(states.size()));
        }
        return tiles;
    }

    const RenderOptionTexts& options_;
    const MatrixPlan& matrix_;
    PreparedModel& prepared_;
    MovingView view_;
    std::vector<MovingModel> moving_;
    double start_ = now_seconds();
};

}  // namespace

Result<MatrixPlan> parse_matrix(std::string_view text) {
    MatrixPlan plan;
    std::int64_t states = 1;
    for (const std::string_view piece : split_at_commas(text)) {
        auto steps = parse_steps(piece, MatrixPlan::most_states);
        if (!steps) return steps.error();
        states *= steps->count;
        plan.steps.push_back(std::move(*steps));
    }
    const auto refuse = [](std::string message) {
        return Error{ErrorKind::invalid_argument, std::move(message)};
    };
    if (plan.steps.size() > 2) return refuse("a matrix has rows and columns: at most two names");
    if (states > MatrixPlan::most_states)
        return refuse(fmt::format("{} views are too many; {} are allowed", states, MatrixPlan::most_states));
    return plan;
}

int render_matrix(const RenderOptionTexts& options, const RenderPlan& plan, const MatrixPlan& matrix,
                  PreparedModel& prepared) {
    std::vector<MovingModel> moving;
    for (const Steps& steps : matrix.steps) {
        auto model = MovingModel::make(prepared, steps.along);
        if (!model) return fail({model.error().kind, "--matrix: " + model.error().message});
        if (const Status status = model->set(steps.along.from); !status) return fail(status.error());
        moving.push_back(std::move(*model));
    }
    return MatrixRun(options, plan, matrix, prepared, std::move(moving)).run();
}

}  // namespace frep::cli
