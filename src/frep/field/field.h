// Field: a real function of n coordinates, the one thing the whole system is about. A point is inside the
// shape where the value is >= 0; NaN means undefined, which counts as outside. Attributes (color, material)
// are further roots of the same graph. Immutable and cheap to copy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frep/field/graph.h"
#include "frep/field/region.h"

namespace frep {

/// Coordinates a model may have, parameters and attributes an object may have.
inline constexpr int max_coordinates = 16;
inline constexpr int max_parameters = 1000;
inline constexpr int max_attributes = 1000;

struct Field {
    std::shared_ptr<const Graph> graph;
    NodeId value = 0;                ///< root: F
    std::vector<NodeId> attributes;  ///< roots: s[1], s[2], ...
    int coordinates = 3;             ///< n, 0..16
    std::vector<double> parameters;  ///< values of a[1], a[2], ...; may be rebound without a new graph

    /// Value first, then attributes.
    std::vector<NodeId> roots() const {
        std::vector<NodeId> all{value};
        all.insert(all.end(), attributes.begin(), attributes.end());
        return all;
    }
};

/// `field` with its parameters replaced by their present values, so that what depends on nothing else is
/// computed once and not at every point. The values keep their bits. The field itself when no parameter is
/// used. field.parameters must have a value for each parameter that the graph uses.
Field bind_parameters(const Field& field);

/// True when a node that F or an attribute needs is a region (a loop that depends on the point).
bool has_regions(const Field& field);

}  // namespace frep
