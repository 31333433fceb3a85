// One block of a plane section: samples, edge nodes, and the pieces of outline in its cells. A block owns the
// edges whose lower sample is among its samples; pieces name nodes of other blocks by number. The block of
// block.h in two dimensions. Tested through tests/unit/contour/contour_2d_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frep/contour/plane_grid.h"
#include "frep/contour/quadtree.h"
#include "frep/eval/sampled_field.h"

namespace frep::contouring {

/// Where the outline crosses an edge, or a sample on the box's boundary that the cap goes through. `id`: the
/// number of the edge's lower sample times 3, plus the axis, or plus cap_node for a sample itself.
struct PlaneNode {
    std::uint64_t id = 0;
    Vec2 point;
};
inline constexpr std::uint64_t cap_node = 2;

/// A piece of outline between two nodes, with the solid to the left.
struct PlanePiece {
    std::uint64_t from = 0, to = 0;  ///< ids of nodes
};

struct PlanePart {
    std::vector<PlaneNode> nodes;
    std::vector<PlanePiece> pieces;
};

/// Contours blocks, one after the other; keeps its scratch memory between them. Serves one thread.
class PlaneContourer {
  public:
    PlaneContourer(const PlaneGrid& grid, SampledField& field, bool cap)
        : grid_(grid), field_(field), cap_(cap) {}

    /// The block's part of the outlines. Adds to the tallies below.
    PlanePart contour(const PlaneBlock& block);

    PlaneTally undefined;
    std::array<bool, 4> touches{};  ///< sides left, right, bottom, top that the shape reaches

  private:
    static constexpr std::uint32_t lattice_side = plane_block_side + 1;
    static constexpr std::uint32_t lattice_size = lattice_side * lattice_side;
    using Local = std::array<std::uint32_t, 2>;  ///< sample of the lattice, 0 .. plane_block_side

    /// An edge being bisected; the bracket is kept as parameters 0..1.
    struct Bracket {
        std::size_t node = 0;  ///< its place in part_.nodes
        std::size_t axis = 0;
        double start = 0, length = 0;
        double inside = 0, outside = 0;
    };

    static std::uint32_t index(const Local& l) { return l[1] * lattice_side + l[0]; }
    std::uint32_t with_layer(std::size_t axis, std::uint32_t local) const { return lo_[axis] + local; }
    bool is_layer(std::size_t axis, std::uint32_t local) const {
        const std::uint32_t e = with_layer(axis, local);
        return e == 0 || e > grid_.cells[axis] + 1;
    }
    bool is_layer(const Local& l) const { return is_layer(0, l[0]) || is_layer(1, l[1]); }
    std::uint64_t number(const Local& l) const {
        return grid_.number(with_layer(0, l[0]), with_layer(1, l[1]));
    }
    bool is_at_side(const Local& l) const;
    Vec2 sample_point(const Local& l) const {
        return grid_.point(with_layer(0, l[0]) - 1, with_layer(1, l[1]) - 1);
    }

    bool sample();
    void note_samples();
    void collect_nodes();
    void add_node(const Local& lower, std::size_t axis);
    void put(std::size_t at, Vec2 p);
    void bisect();
    void add_pieces();
    void add_cell(const Local& corner);
    std::uint64_t node_id(const Local& cell, std::size_t edge) const;

    const PlaneGrid& grid_;
    SampledField& field_;
    bool cap_;
    Local lo_{}, first_{}, last_{};
    std::array<double, lattice_size> values_{};
    std::array<std::uint8_t, lattice_size> inside_{};
    std::vector<double> x_, y_, z_, out_;
    std::vector<Bracket> brackets_;
    PlanePart part_;
};

}  // namespace frep::contouring
