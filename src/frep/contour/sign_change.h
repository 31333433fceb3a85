// SignSearch: how far it is from points to the nearest change of sign along given lines; only the farthest of
// a batch is wanted. Tested through tests/unit/contour/mesh_error_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frep/eval/sampled_field.h"

namespace frep::contouring {

/// A point near the surface with a direction to look in, of length 1; both ways are tried.
struct SignProbe {
    Vec3 point, direction;
};

struct FarthestSign {
    std::optional<double> distance;  ///< nothing when no probe found a change
    Vec3 place;                      ///< the probe's point
    std::size_t unresolved = 0;      ///< probes that found none within reach
};

/// The largest distance from a probe to its first change of sign ("defined and F >= 0"), up to a
/// thousandth of it. `directions` of zero length take the gradient; probes whose gradient is zero or
/// undefined take the given direction.
class SignSearch {
  public:
    /// `reach`: how far to look; `start`: the first step where the gradient tells none. Model units.
    SignSearch(SampledField& field, double reach, double start)
        : field_(field), reach_(reach), start_(start) {}

    FarthestSign farthest(std::span<const SignProbe> probes);

  private:
    /// A probe with what is known: no change up to `low`, one at `high` (on the side `way`).
    struct Line {
        Vec3 point, direction;
        bool inside = false;
        double low = 0, high = 0;
        double step = 0;
        double way = 0;  ///< +1 or -1 along direction once found, else 0
    };

    void take_gradients(std::span<const SignProbe> probes);
    void expand();
    void narrow();
    void evaluate(std::size_t count);

    SampledField& field_;
    double reach_, start_;
    std::vector<Line> lines_;
    std::vector<std::size_t> active_;
    std::vector<double> x_, y_, z_, values_, gx_, gy_, gz_;
};

}  // namespace frep::contouring
