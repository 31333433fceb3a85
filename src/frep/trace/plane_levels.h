// Round numbers for axes and levels: steps of 1, 2 or 5 times a power of ten, the multiples of a step as
// correctly rounded decimals, and how they are written in a picture.
// Tested by tests/unit/trace/plane_levels_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace frep::drawing {

/// A step of mantissa * 10^exponent, the mantissa 1, 2 or 5.
struct Step {
    int mantissa = 1, exponent = 0;

    /// The double nearest to k steps.
    double times(std::int64_t k) const;
};

/// The smallest round step that is at least `size` (finite, > 0).
Step round_step(double size);

/// Multiples of a round step from `low` to `high`, at most `count` + 1 of them; none unless low < high, both
/// finite, with more than a few doubles between them. count >= 1.
struct Ticks {
    Step step;
    std::vector<double> values;
};
Ticks round_ticks(double low, double high, int count);

/// The numbers as labels of one scale: all with the same number of decimals, a true minus sign, and, for very
/// large or small ones, without a common power of ten, which is then in `factor`: " (x10^6)" with the signs
/// of typography, empty if there is none.
struct Labels {
    std::vector<std::string> texts;
    std::string factor;
};
Labels tick_labels(const Ticks& ticks);
/// Labels of arbitrary numbers: up to six digits each.
Labels number_labels(std::span<const double> values);

/// What a picture of a function shows: where its values change color.
struct Levels {
    std::vector<double> values;  ///< ascending, all different; not empty
    bool uniform = true;         ///< multiples of `step`
    Step step;
    double lowest = 0, highest = 0;  ///< of the defined samples; infinite ones count; 0 when there are none
    std::uint64_t defined = 0, undefined = 0;  ///< samples
};

/// Levels for samples (NaN: undefined): about `count` round ones over the range that 96 of 100 defined finite
/// samples share, with 0 if the samples have both signs.
Levels choose_levels(std::span<const double> samples, int count);

/// The given levels (finite, at least one), sorted, with 0 if the samples have both signs.
Levels given_levels(std::span<const double> samples, std::vector<double> values);

}  // namespace frep::drawing
