// EdgeRoots: where the surface crosses edges of the lattice, all edges of a block in a few batches. Each edge
// keeps a bracket of an inside and an outside point. Where the samples on the line of the edge have given a
// model of F (see predict), the first point is the root of the model, the second a Newton step with its
// slope, corrected by the first value. If both values are about as small as they should be, F follows its
// model along the whole edge and crosses it once. Else the edge is doubtful: it may have several crossings,
// and values must not choose among them, for those of a pruned part are others off the surface. Signs choose:
// the edge is bisected three times, by eight parts at once, and again until a secant meets a small value,
// three rounds at most. After that a step tries the point of the secant, moved a little towards the middle;
// all are held so near to the middle that bisection never needs more than six steps less (the ITP method of
// Oliveira and Takahashi 2020, "An enhancement of the bisection method average performance preserving minmax
// optimality"). Where a value is not finite it is the middle. Every edge is searched from its lower to its
// upper end, alone: the result does not depend on the batch. Tested by
// tests/unit/contour/adaptive_roots_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frep/eval/sampled_field.h"
#include "frep/math/vec.h"

namespace frep::contouring {

/// F along an edge as the polynomial through the samples there, about its root.
struct EdgeModel {
    double root = -1;                            ///< t, about; no number of [0, 1]: there is no model
    double value = 0;                            ///< of the polynomial at `root`
    double slope = 0;                            ///< by t
    bool has_before = false, has_after = false;  ///< the samples at t = -1, t = 2 have been used

    bool is_known() const { return root >= 0 && root <= 1; }
};

/// An edge with different signs at its ends; t runs from 0 at `lower` to 1, along the axis.
struct CrossedEdge {
    Vec3 lower;
    double length = 0;  ///< coordinate of the upper end minus that of the lower
    std::uint8_t axis = 0;
    double lower_value = 0, upper_value = 0;  ///< of F; one is >= 0, the other < 0 or NaN
    EdgeModel model;
};

/// Sets the model of an edge from F at t = -1 and t = 2: the cubic through four values (Everett's formula),
/// or the parabola through three where one of these is not finite. None where both or an end are not, or
/// where it may cross 0 three times.
void predict(CrossedEdge& edge, double before, double after);

/// The bracket that was found, narrower than root_width.
struct EdgeRoot {
    double inside = 0, outside = 1;  ///< t of the ends; F >= 0 is defined at `inside`
    bool is_wall = false;            ///< F is undefined at `outside`
};

/// In edges. Beside a crease of an R-function the gradient turns within the bracket, so that a wider one
/// shows in the vertices where a pruned part has no crease.
inline constexpr double root_width = 1e-12;

class EdgeRoots {
  public:
    /// roots[i] = the crossing of edges[i].
    void find(SampledField& field, const std::vector<CrossedEdge>& edges, std::vector<EdgeRoot>& roots);

  private:
    struct Bracket {
        double low, high, low_value, high_value;
        double low_weight, high_weight;  ///< the values, as the secant takes them

        void move_end(double t, double value) {
            if ((value >= 0) == (low_value >= 0)) {
                shrink(low_value, value, high_weight);
                low = t;
                low_value = low_weight = value;
            } else {
                shrink(high_value, value, low_weight);
                high = t;
                high_value = high_weight = value;
            }
        }
        /// The weight of the end that stays where it is, after the other end's value went from `old` to
        /// `now`: scaled down, so that the end is soon replaced too (Anderson and Bjorck 1973).
        static void shrink(double old, double now, double& kept) {
            const double scale = 1 - now / old;
            kept *= scale > 0 && scale <= 1 ? scale : 0.5;
        }
    };
    static Bracket whole(const CrossedEdge& edge);
    static double next_try(const Bracket& b, const EdgeModel& model, double first_value, int step);

    void set_point(std::size_t k, const CrossedEdge& edge, double t) {
        t_[k] = t;
        x_[k] = edge.lower.x;
        y_[k] = edge.lower.y;
        z_[k] = edge.lower.z;
        (edge.axis == 0 ? x_ : edge.axis == 1 ? y_ : z_)[k] += t * edge.length;
    }
    void evaluate(SampledField& field, std::size_t count);
    void advance(SampledField& field, const std::vector<CrossedEdge>& edges, int step);
    void bisect(SampledField& field, const std::vector<CrossedEdge>& edges);

    std::vector<Bracket> brackets_;
    std::vector<std::uint32_t> active_;    ///< the edges whose values lead the search
    std::vector<std::uint32_t> doubtful_;  ///< those where values are not what the guess said
    std::vector<double> x_, y_, z_, t_, values_;
};

/// The point at t of an edge.
inline Vec3 point_on(const CrossedEdge& edge, double t) {
    Vec3 p = edge.lower;
    (edge.axis == 0 ? p.x : edge.axis == 1 ? p.y : p.z) += t * edge.length;
    return p;
}

}  // namespace frep::contouring
