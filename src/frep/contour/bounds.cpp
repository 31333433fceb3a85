// Implementation of bounds.h.
#include "frep/contour/bounds.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace frep {

namespace {

using Corner = std::array<double, 3>;

/// A part of the cube. `is_full`: surely inside the shape everywhere, needs no subdivision.
struct Part {
    Corner lo{}, hi{};
    bool is_full = false;
};

Box3 box_of(const Corner& lo, const Corner& hi) { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }

double longest_side(const Part& part, const std::array<bool, 3>& axes) {
    double longest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        if (axes[a]) longest = std::max(longest, part.hi[a] - part.lo[a]);
    }
    return longest;
}

/// The search in one cube: the parts that may hold some of the shape.
class Search {
  public:
    Search(SampledField& field, const BoundsOptions& options) : field_(field), options_(options) {}

    /// The hull of what may be inside in the cube [-half, half]^3; nothing if that is surely empty.
    std::optional<Part> hull_in_cube(double half, const Job& job) {
        Part cube{{-half, -half, -half}, {half, half, half}};
        for (std::size_t a = 0; a < 3; ++a) {
            if (options_.axes[a]) continue;
            cube.lo[a] = -options_.initial;
            cube.hi[a] = options_.initial;
        }
        parts_.clear();
        judge({cube});
        const std::size_t stop = evaluations + options_.evaluations_a_cube;
        while (!parts_.empty() && evaluations < stop && !job.cancelled()) {
            std::vector<Part> children;
            take_outermost(hull(), children);
            if (children.empty()) break;
            judge(children);
        }
        if (parts_.empty()) return std::nullopt;
        return hull();
    }

    std::size_t evaluations = 0;

  private:
    Part hull() const {
        Part all = parts_.front();
        for (const Part& part : parts_) {
            for (std::size_t a = 0; a < 3; ++a) {
                all.lo[a] = std::min(all.lo[a], part.lo[a]);
                all.hi[a] = std::max(all.hi[a], part.hi[a]);
            }
        }
        return all;
    }

    /// Removes the parts that decide where the hull ends and are neither full nor small, and appends their
    /// children. A side of the hull that a full part reaches needs no further search.
    void take_outermost(const Part& all, std::vector<Part>& children) {
        std::array<bool, 6> is_settled{};
        for (std::size_t a = 0; a < 3; ++a) {
            is_settled[2 * a] = is_settled[2 * a + 1] = !options_.axes[a];
        }
        for (const Part& part : parts_) {
            if (!part.is_full) continue;
            for (std::size_t a = 0; a < 3; ++a) {
                is_settled[2 * a] = is_settled[2 * a] || part.lo[a] == all.lo[a];
                is_settled[2 * a + 1] = is_settled[2 * a + 1] || part.hi[a] == all.hi[a];
            }
        }
        const double small = longest_side(all, options_.axes) / 128;
        const auto is_taken = [&](const Part& part) {
            if (part.is_full || longest_side(part, options_.axes) <= small) return false;
            for (std::size_t a = 0; a < 3; ++a) {
                if (part.lo[a] == all.lo[a] && !is_settled[2 * a]) return true;
                if (part.hi[a] == all.hi[a] && !is_settled[2 * a + 1]) return true;
            }
            return false;
        };
        std::vector<Part> kept;
        for (const Part& part : parts_) {
            if (is_taken(part)) {
                append_children(part, children);
            } else {
                kept.push_back(part);
            }
        }
        parts_ = std::move(kept);
    }

    void append_children(const Part& part, std::vector<Part>& children) const {
        for (unsigned c = 0; c < 8; ++c) {
            Part child = part;
            bool is_new = true;
            for (std::size_t a = 0; a < 3; ++a) {
                const bool upper = (c >> a & 1u) != 0;
                if (!options_.axes[a]) {
                    is_new = is_new && !upper;
                    continue;
                }
                const double middle = part.lo[a] + 0.5 * (part.hi[a] - part.lo[a]);
                (upper ? child.lo[a] : child.hi[a]) = middle;
            }
            if (is_new) children.push_back(child);
        }
    }

    /// Evaluates the candidates and keeps those that may hold some of the shape.
    void judge(const std::vector<Part>& candidates) {
        std::vector<Box3> boxes;
        for (const Part& part : candidates) boxes.push_back(box_of(part.lo, part.hi));
        std::vector<SignRange> ranges(boxes.size());
        field_.ranges(boxes, ranges);
        evaluations += boxes.size();
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (!ranges[i].can_be_inside) continue;
            parts_.push_back(candidates[i]);
            parts_.back().is_full = !ranges[i].can_be_outside && !ranges[i].can_be_undefined;
        }
    }

    SampledField& field_;
    const BoundsOptions& options_;
    std::vector<Part> parts_;
};

/// The sides of the cube that the hull reaches, on the axes in use.
std::array<bool, 6> reached_sides(const Part& hull, double half, const std::array<bool, 3>& axes) {
    std::array<bool, 6> reached{};
    for (std::size_t a = 0; a < 3; ++a) {
        reached[2 * a] = axes[a] && hull.lo[a] <= -half;
        reached[2 * a + 1] = axes[a] && hull.hi[a] >= half;
    }
    return reached;
}

Box3 with_margin(Part hull, const BoundsOptions& options) {
    const double margin = options.margin * longest_side(hull, options.axes);
    for (std::size_t a = 0; a < 3; ++a) {
        if (!options.axes[a]) continue;
        hull.lo[a] -= margin;
        hull.hi[a] += margin;
    }
    return box_of(hull.lo, hull.hi);
}

}  // namespace

Result<AutomaticBounds> automatic_bounds(SampledField& field, const BoundsOptions& options, const Job& job) {
    AutomaticBounds result;
    result.box = Box3::cube(options.initial);
    Search search(field, options);
    for (double half = options.initial;; half = std::min(half * options.growth, options.largest)) {
        const std::optional<Part> hull = search.hull_in_cube(half, job);
        if (job.cancelled()) return Error{ErrorKind::cancelled, "the search for bounds was cancelled"};
        result.evaluations = search.evaluations;
        if (!hull) {
            result.empty = true;
            return result;
        }
        result.reaches = reached_sides(*hull, half, options.axes);
        const bool is_cut =
            std::find(result.reaches.begin(), result.reaches.end(), true) != result.reaches.end();
        if (!is_cut) {
            result.box = with_margin(*hull, options);
            return result;
        }
        if (half >= options.largest) break;
    }
    result.unbounded = true;
    return result;
}

}  // namespace frep
