// The HyperFun text that `frep morph` writes: the objects of two models, renamed, and one that blends them in
// space-time. Tested by tests/cli/morph.txt.
#pragma once

#include <array>
#include <string>

#include "model_input.h"

namespace frep::cli {

/// Numbers of the blend, for time from -span to span and shapes whose values run through about 8 units.
struct MorphBlend {
    double a0 = 0, a1 = 2, a2 = 2, a3 = 1, b0 = -0.5, c = 5;
    static constexpr double span = 10;
};

struct MorphPlan {
    std::array<const PreparedModel*, 2> parts{};
    std::array<double, 2> factors{1, 1};  ///< of the values of the shapes
    Box3 box;                             ///< around both
    MorphBlend blend;
    double from = -10, to = 10;  ///< time of the first and of the second shape
    bool plain = false;          ///< half-cylinders with flat ends

    /// Those of each model: 2 or 3.
    std::size_t coordinates() const { return static_cast<std::size_t>(parts[0]->header().coordinates()); }
    /// Of both models together.
    std::size_t parameter_count() const;
};

/// The model; `a0` is a number or a parameter, of which the model then has one more than both together.
std::string morph_text(const MorphPlan& plan, const std::string& a0);

}  // namespace frep::cli
