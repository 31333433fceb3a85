// EdgeStar: the leaves around a crossed edge of the lattice, the arcs between them, and what the mesh makes
// of them; see dual_mesh.h for the rules. Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "frep/contour/dual_region.h"

namespace frep::contouring {

/// An edge of the lattice: a block of the surroundings and a number in it.
struct EdgeName {
    std::size_t block = 13;
    std::uint32_t number = 0;
};

class EdgeStar {
  public:
    /// What the mesh makes of the edge; `turned` has a bit for each face around it.
    struct State {
        static constexpr std::uint8_t turned = 15, kept = 16, second_diagonal = 32, dead = 64;
    };

    /// Both stay as they are while this is used; `region` is that of `around`.
    EdgeStar(const Surroundings& around, const DualRegion& region) : around_(around), region_(region) {}

    /// Looks at the own edge `number` of the block in the middle, crossed at `root`. False when a cell is
    /// missing that the edge says must be there.
    bool look(std::uint32_t number, double root);
    /// Decides; after look().
    std::uint8_t state() const;

    /// The vertices around the edge, counter-clockwise seen from its upper end, by quadrant: equal for
    /// quadrants of one leaf, no_vertex outside of the box.
    std::uint32_t vertex(std::size_t quadrant) const;
    static constexpr std::uint32_t no_vertex = 0xffffffffu;
    /// There is no arc in the face between this quadrant and the next: both belong to one leaf, or to none.
    bool is_one_leaf(std::size_t quadrant) const {
        return !is_plain_ && key(quadrant) == key((quadrant + 1) % 4);
    }
    bool lower_is_inside() const;
    /// The other end of the arc in the face between this quadrant and the next.
    EdgeName partner(std::size_t quadrant) const;

  private:
    using Cell = DualRegion::Cell;
    /// A leaf with the lower corner of its cell.
    struct Side {
        const Cell* cell = nullptr;
        Signed corner{};
        std::uint8_t edge = 0;  ///< number of the edge in the cell

        std::int32_t leaf_start(std::size_t axis) const { return cell->leaf_start(corner[axis]); }
    };
    /// The face between two quadrants: its normal axis, and the axis that leads away from the edge.
    struct Face {
        std::size_t normal = 0, away = 0;
        bool is_forward = true;            ///< lies on the positive side of the edge along `away`
        std::size_t below = 0, above = 0;  ///< the quadrants
    };

    Side side(std::size_t quadrant) const;
    std::uint32_t key(std::size_t quadrant) const;
    std::uint32_t outside_of_box(const Signed& corner) const;
    Face face(std::size_t quadrant) const;
    std::uint8_t turned_arcs() const;
    std::uint8_t cut(std::uint8_t turned, const std::array<std::size_t, 4>& quadrants,
                     std::size_t count) const;
    EdgeName name_of(const Signed& lower, std::size_t axis) const;
    bool is_crossed(const EdgeName& name) const;
    EdgeName crossing_on_sides(const Face& face, const Side& small) const;

    const Surroundings& around_;
    const DualRegion& region_;
    const std::array<CellPattern, 256>& patterns_ = cell_patterns();
    Signed lower_{};
    std::size_t axis_ = 0, u_ = 1, v_ = 2;
    double root_ = 0;
    bool is_plain_ = false;                   ///< four cells around the edge, each its own leaf
    std::array<std::uint32_t, 4> indices_{};  ///< of the cells, in the region
    std::array<const Cell*, 4> cells_{};      ///< null: outside of the box
};

}  // namespace frep::contouring
