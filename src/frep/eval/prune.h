// Pruner: what part of a field matters in a box. It finds the range of F over up to 16 boxes at a time, and
// for the boxes where the sign of F is open a shorter tape that stands for F there. Method: interval
// arithmetic with a box in each lane (Duff 1992; Keeter 2020), then a pass from the root down that drops
// operands by what is demanded of them, the sign alone or the value
// (docs/decisions/0012-pruning-by-demand.md); boxes whose choices agree share one tape. Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/eval/isa.h"

namespace frep {

/// Boxes that go through one pass together.
inline constexpr int tile_lanes = 16;

/// Closed boxes, one a lane: lane k is [lo[i][k], hi[i][k]] in coordinate i of the model. Lanes from `count`
/// on and coordinates beyond those of the model are not read.
struct BoxLanes {
    int count = 0;  ///< 1 .. tile_lanes
    std::array<std::array<double, tile_lanes>, max_coordinates> lo, hi;
};

/// Ranges of F over boxes, as binary32 rounded outward. They enclose the exact values of F and the values
/// that engines compute, in binary64 and in binary32 (see Pruner). Bit k of a mask speaks of box k; bits from
/// `count` on are 0. A point is inside where F is defined and F >= 0.
struct RangeLanes {
    std::array<float, tile_lanes> lo{}, hi{};
    std::uint16_t can_be_inside = 0;
    std::uint16_t can_be_outside = 0;  ///< negative, or undefined
    std::uint16_t can_be_undefined = 0;

    /// Boxes where both sides are possible.
    std::uint16_t open() const { return can_be_inside & can_be_outside; }
};

/// What a cut tape must keep.
enum class Purpose {
    value,      ///< every value: the same number at each point of the box (a zero may change its sign)
    sign,       ///< the sign (negative, zero, positive, undefined) at each point, hence the zero set; and the
                ///< gradient on the zero set
    occupancy,  ///< the sign alone: R-functions become min and max where that is enough. Gradients and the
                ///< size of values mean nothing
};

/// Answer of Pruner::cut(). Keep one for each level of a recursion: its tapes are overwritten in place, so
/// that nothing is allocated once they have grown. Copy or move a tape out to keep it longer.
struct CutResult {
    static constexpr std::int8_t none = -1;   ///< decided: no tape is needed
    static constexpr std::int8_t whole = -2;  ///< go on with the tape that was cut: too little would go

    RangeLanes ranges;
    std::array<std::int8_t, tile_lanes> tape_of{};  ///< by box: a number in `tapes`, none, or whole
    int tape_count = 0;
    std::vector<ClauseTape> tapes;  ///< the first tape_count of them; in single assignment
};

/// One thread's pruner; it keeps its workspace between calls. Its results depend on the tape and the boxes
/// alone: neither on the instruction set nor on earlier calls.
///
/// Engines in binary32 are enclosed when they round constants and coordinates to nearest, compute arithmetic,
/// square roots, rounding, comparisons, min, max and select in binary32, functions of one variable and hypot
/// within 2 ulp, R-functions within 4 ulp (saturated nowhere below 1e18) and with the sign of min or max, and
/// every other operation in binary64, rounded once.
class Pruner {
  public:
    explicit Pruner(Isa isa = machine_isa());
    ~Pruner();
    Pruner(Pruner&&) noexcept;
    Pruner& operator=(Pruner&&) noexcept;

    /// Ranges of F over the boxes. `tape` must be in single assignment (make_clause_tape() or cut()).
    void ranges(const ClauseTape& tape, const BoxLanes& boxes, RangeLanes& out);

    /// Ranges, and tapes that stand for `tape` in the boxes: for Purpose::value in all of them, otherwise in
    /// those where the sign is open. A cut tape holds for points of its box only, and a tape that was cut for
    /// a purpose serves that purpose and, for `sign`, occupancy. `out` must not hold `tape`.
    void cut(const ClauseTape& tape, const BoxLanes& boxes, Purpose purpose, CutResult& out);

    /// As cut() for Purpose::sign, without small terms of sums: in binary64 a value of these tapes has the
    /// sign of F where its size is larger than the number returned, and is undefined where F is. (With the
    /// terms it would have that everywhere; what they may change is no more than that number.) It is about
    /// `share` of the narrowest range of F among the open boxes; infinite where rounding cannot be bounded.
    double cut_near(const ClauseTape& tape, const BoxLanes& boxes, double share, CutResult& out);

    /// Clauses run by all passes so far, a clause of 16 boxes counted once for each box.
    std::size_t tile_operations() const;

  private:
    struct Workspace;
    std::unique_ptr<Workspace> workspace_;
};

}  // namespace frep
