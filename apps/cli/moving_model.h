// A model that changes along one of its coordinates or parameters: what the frames of an animation show.
// Tested by tests/cli/animate.txt.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "model_input.h"

namespace frep::cli {

/// What `--along NAME=A..B` says.
struct Along {
    std::string name;
    double from = 0, to = 0;
};
Result<Along> parse_along(std::string_view text);
/// What `--matrix` and `--color-by` say: NAME=A:B:N, N values from A to B.
struct Steps {
    Along along;
    int count = 0;
};
/// `most`: the largest number of values allowed.
Result<Steps> parse_steps(std::string_view text, int most);
/// `count` >= 2 values from the beginning to the end.
std::vector<double> evenly_spaced(const Along& along, int count);

class MovingModel {
  public:
    /// `along` may be missing: then nothing moves. A name is looked for among the coordinates (x, t, x5),
    /// then among the parameters (the names of `--@ param` lines, a[3]). Errors: invalid_argument for an
    /// unknown name, or a coordinate that `--map` uses as an axis.
    static Result<MovingModel> make(PreparedModel& prepared, const std::optional<Along>& along);

    /// Moves to `value`. Errors: invalid_model when the model cannot be lowered with this parameter (the
    /// findings are printed).
    Status set(double value);
    /// The field at the present value. Errors: as of sampled_field().
    Result<std::unique_ptr<SampledField>> field(double iso, bool attributes) const;

    /// The name with its number: "t", "height".
    const std::string& name() const { return name_; }

  private:
    explicit MovingModel(PreparedModel& prepared) : prepared_(&prepared) {}

    PreparedModel* prepared_;
    std::string name_;
    std::optional<std::size_t> coordinate_, parameter_;
};

}  // namespace frep::cli
