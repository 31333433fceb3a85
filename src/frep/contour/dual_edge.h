// EdgeStar: the leaves around a crossed edge of the lattice, the arcs between them, and what the mesh makes
// of them; see dual_mesh.h for the rules. Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "frep/contour/dual_block.h"

namespace frep::contouring {

/// A block with its neighbours and the numbers of their first leaf vertices in the mesh.
struct Surroundings {
    std::array<const DualBlock*, 27> blocks{};  ///< entry (dx + 1) + 3 (dy + 1) + 9 (dz + 1); null: none
    std::array<std::uint32_t, 27> ranks{};      ///< position in the list of blocks
    std::array<std::uint32_t, 27> first_vertex{};
    Lattice lo{};     ///< first sample of the block in the middle, with layer
    Lattice cells{};  ///< of the grid
    bool cap = false;
    double margin = 0;
    double keep_distance = 0;  ///< crossings farther than that from the cut polygon stay vertices, in cells
};

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
    using Signed = std::array<std::int32_t, 3>;  ///< lattice coordinates from the block's first sample

    explicit EdgeStar(const Surroundings& around) : around_(around) {}

    /// Looks at the own edge `number` of the block in the middle. False when a cell is missing that the edge
    /// says must be there.
    bool look(std::uint32_t number);
    /// Decides; after look().
    std::uint8_t state() const;

    /// The vertices around the edge, counter-clockwise seen from its upper end, by quadrant: equal for
    /// quadrants of one leaf, no_vertex outside of the box.
    std::uint32_t vertex(std::size_t quadrant) const { return sides_[quadrant].vertex; }
    static constexpr std::uint32_t no_vertex = 0xffffffffu;
    /// There is no arc in the face between this quadrant and the next: both belong to one leaf, or to none.
    bool is_one_leaf(std::size_t quadrant) const;
    bool lower_is_inside() const { return lower_is_inside_; }
    /// The other end of the arc in the face between this quadrant and the next.
    EdgeName partner(std::size_t quadrant) const;

  private:
    /// The leaf in a quadrant. Lattice coordinates count from the first sample of the block in the middle.
    struct Side {
        const DualCell* cell = nullptr;  ///< null: outside of the box
        const DualBlock* block = nullptr;
        Signed corner{};  ///< of the cell
        Signed block_corner{};
        std::uint32_t local_vertex = 0;  ///< in the block
        std::uint32_t vertex = no_vertex;
        std::uint32_t key = 0;  ///< equal for quadrants of one leaf
        std::uint8_t edge = 0;  ///< number of the edge in the cell
        std::uint8_t sheets = 0;

        std::int32_t size() const { return 1 << cell->level; }
        std::int32_t leaf_start(std::size_t axis) const {
            return (corner[axis] >> cell->level) * (1 << cell->level);
        }
    };
    /// The face between two quadrants: its normal axis, and the axis that leads away from the edge.
    struct Face {
        std::size_t normal = 0, away = 0;
        bool is_forward = true;  ///< lies on the positive side of the edge along `away`
        const Side* below = nullptr;
        const Side* above = nullptr;
    };

    bool find_side(std::size_t quadrant);
    Face face(std::size_t quadrant) const;
    bool is_turned(std::size_t quadrant) const;
    bool is_ambiguous(const Face& face) const;
    std::uint8_t cut(std::uint8_t turned, std::span<const std::size_t> corners) const;
    Vec3 place(const Side& side) const;
    EdgeName name_of(const Signed& lower, std::size_t axis) const;
    bool is_crossed(const EdgeName& name) const;
    EdgeName crossing_on_sides(const Face& face, const Side& small) const;

    const Surroundings& around_;
    Signed lower_{};
    std::size_t axis_ = 0, u_ = 1, v_ = 2;
    double root_ = 0;
    bool lower_is_inside_ = false;
    std::array<Side, 4> sides_;
};

}  // namespace frep::contouring
