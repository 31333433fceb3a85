// SignSearch: how far it is from points to the nearest change of sign of F. A first search along the gradient
// gives every point a distance that is never too short; those that matter are then searched in all
// directions. Tested through tests/unit/contour/mesh_error_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"

namespace frep::contouring {

/// A point near the surface with a direction to look in, of length 1; both ways are tried.
struct SignProbe {
    Vec3 point, direction;
};

/// A probe with what is known of its distance.
struct SignLine {
    Vec3 point, direction;
    bool inside = false;
    double low = 0;  ///< no change up to here along the line, to the resolution of the steps
    double high =
        std::numeric_limits<double>::infinity();  ///< a change lies within this distance; else infinite
    double step = 0;                              ///< of the search under way
    double way = 0;  ///< the change lies at +high or -high along the direction; 0: not found
    bool refined = false;
};

class SignSearch {
  public:
    /// `reach`: how far to look; `start`: the first step where the gradient tells none. Model units.
    SignSearch(SampledField& field, double reach, double start)
        : field_(field), reach_(reach), start_(start) {}

    /// Searches along the gradient, both ways; probes whose gradient is zero or undefined take the given
    /// direction. The farthest of the lines is known to a thousandth, others as far as needed to tell that.
    std::vector<SignLine> search(std::span<const SignProbe> probes);

    /// Looks for a nearer change: in 26 directions, and along the gradient at the nearest that was found.
    void refine(SignLine& line);

  private:
    using Line = SignLine;

    void take_gradients(std::span<const SignProbe> probes);
    void expand();
    void narrow();
    void evaluate(std::size_t count);
    void shorten(SignLine& line, std::span<const Vec3> directions);

    SampledField& field_;
    double reach_, start_;
    std::vector<Line> lines_;
    std::vector<std::size_t> active_;
    std::vector<double> x_, y_, z_, values_, gx_, gy_, gz_;
};

}  // namespace frep::contouring
