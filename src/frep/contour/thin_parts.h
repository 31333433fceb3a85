// ThinParts: walls, gaps, rods and small balls that no sample of a block meets. Along each line of the
// lattice, F of a wall between two samples rises towards it from both sides: the line through the two samples
// before it and that through the two after it meet above 0. Where they do so between samples with the sign of
// all samples around, F is asked for; a few steps follow the kink or the top. Tops that stay below 0 but less
// than a cell away, as beside a rod, are followed along the gradient. What is found is certain, for a point
// with the other sign was seen; what is much thinner than a thousandth of a cell, or has something else as
// near, may be missed. Tested by tests/unit/contour/thin_parts_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "frep/contour/block_tasks.h"
#include "frep/contour/grid.h"

namespace frep::contouring {

/// The samples of a block and of the first layer of the next ones, 9^3, x fastest.
struct SampleBlock {
    static constexpr std::uint32_t side = block_side + 1;

    const Grid& grid;
    std::span<const double, side * side * side> values;
    std::span<const std::uint32_t, side * side> rows;  ///< bit x of row y + z * side: the sample is inside
    std::array<std::uint32_t, 3> lo{};                 ///< the first sample in the lattice, with layer
    std::array<std::uint32_t, 3> first{}, last{};      ///< of the local samples, 0 to 8: those of the box

    Vec3 point(const std::array<std::uint32_t, 3>& l) const {
        return grid.point(lo[0] + l[0] - 1, lo[1] + l[1] - 1, lo[2] + l[2] - 1);
    }
};

class ThinParts {
  public:
    /// Local samples, from the first to the last along each axis; they may lie in the blocks around.
    struct Around {
        std::array<std::int32_t, 3> begin{}, end{};
    };

    /// The numbers, ascending, of cells of the block that hold a point with another sign than all samples
    /// around them; valid until the next call.
    std::span<const std::uint32_t> find(const SampleBlock& block, const BlockFields& fields);

  private:
    /// A place of a line of the lattice: t counts samples from the lower end of a pair; the value is F, or -F
    /// where the samples are inside.
    struct Place {
        double t = 0, value = 0;
    };
    /// How far up the lines of a Top meet.
    enum class Meeting : std::uint8_t { nowhere, below, above };
    /// Two places on each side of what a pair of samples may hide, in the order of t, with values < 0.
    struct Top {
        Vec3 lower;             ///< the lower sample
        Around around;          ///< the samples of the cells around the pair
        std::uint8_t axis = 0;  ///< of the line
        double sign = 1;        ///< times F is the value
        std::array<Place, 4> places{};
        double t = 0;            ///< where the lines through the first and the last two meet
        Vec3 point;              ///< where F is asked for
        double value = 0;        ///< there
        double first_value = 0;  ///< the value before that
        Vec3 gradient;           ///< of the values, at the point

        void move_to(double at, double cell);
        Meeting meeting();
        void narrow();
    };

    void collect(const SampleBlock& block);
    void add(const SampleBlock& block, const std::array<std::uint32_t, 3>& lower, std::size_t axis);
    void close_ends(const SampleBlock& block, const BlockFields& fields);
    void follow_lines(const SampleBlock& block, const BlockFields& fields);
    void follow_gradients(const SampleBlock& block, const BlockFields& fields);
    void take_points();
    void take_values(SampledField& field);
    bool agree_beyond(const SampleBlock& block, const Around& around, bool inside, SampledField& whole);
    void drop_found(const SampleBlock& block, SampledField& whole, bool is_off_line);

    /// The first 16 bits of the values, with room for what is loaded before and after them.
    static constexpr std::size_t before_samples = SampleBlock::side * SampleBlock::side;
    std::array<std::int16_t, before_samples*(SampleBlock::side + 3) + 8> heads_{};

    std::vector<Top> tops_, near_;
    std::vector<double> x_, y_, z_, values_, gx_, gy_, gz_;
    std::vector<std::uint32_t> cells_;
};

}  // namespace frep::contouring
