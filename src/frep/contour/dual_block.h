// One block of the lattice for dual contouring: its samples, the crossings of its edges, the vertices of its
// cells. A block owns the edges and cells whose lower sample is among its 8^3 samples, so everything is
// computed once; what lies in the next blocks is read there. Tested by tests/unit/contour/adaptive_test.cpp.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "frep/contour/block_tasks.h"
#include "frep/contour/edge_roots.h"
#include "frep/contour/grid.h"
#include "frep/contour/octree.h"
#include "frep/contour/thin_parts.h"
#include "frep/eval/sampled_field.h"

namespace frep::contouring {

/// The number of bits that are set; as fast on processors without an instruction for it.
constexpr std::uint32_t bit_count(std::uint64_t v) {
    v -= v >> 1 & 0x5555555555555555u;
    v = (v & 0x3333333333333333u) + (v >> 2 & 0x3333333333333333u);
    v = (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return static_cast<std::uint32_t>(v * 0x0101010101010101u >> 56);
}

/// A set of numbers below 64 * Words, with the rank of each member.
template <std::size_t Words>
struct RankedSet {
    std::array<std::uint64_t, Words> bits{};
    std::array<std::uint16_t, Words> before{};

    bool has(std::uint32_t i) const { return (bits[i >> 6] >> (i & 63) & 1) != 0; }
    void insert(std::uint32_t i) { bits[i >> 6] |= std::uint64_t{1} << (i & 63); }
    /// To be called after the last insert().
    void count() {
        std::uint16_t sum = 0;
        for (std::size_t w = 0; w < Words; ++w) {
            before[w] = sum;
            sum = static_cast<std::uint16_t>(sum + bit_count(bits[w]));
        }
    }
    /// How many members are smaller.
    std::uint32_t rank(std::uint32_t i) const {
        return before[i >> 6] + bit_count(bits[i >> 6] & ((std::uint64_t{1} << (i & 63)) - 1));
    }
};

/// Integer coordinates of a sample or cell: with layer in the whole lattice, or local to a block.
using Lattice = std::array<std::uint32_t, 3>;

/// The number of a sample or cell of a block, 0..511, and of an edge from it.
constexpr std::uint32_t local_number(const Lattice& l) {
    return (l[2] * block_side + l[1]) * block_side + l[0];
}
constexpr std::uint32_t edge_number(const Lattice& l, std::size_t axis) {
    return local_number(l) * 3 + static_cast<std::uint32_t>(axis);
}
constexpr Lattice local_of(std::uint32_t number) {
    return {number % block_side, number / block_side % block_side, number / (block_side * block_side)};
}

inline constexpr std::uint8_t no_wish = 255;

/// A cell that the surface crosses.
struct DualCell {
    std::uint16_t number = 0;     ///< in the block
    std::uint8_t signs = 0;       ///< as for cell_pattern()
    std::uint8_t level = 0;       ///< its leaf has the side 2^level
    std::uint8_t wish = no_wish;  ///< the face, numbered as in dual_cell.h, through which an edge leaves it
    std::uint8_t granted = no_wish;  ///< the wish, if its leaf is this cell and the one behind that face
    std::uint32_t vertex = 0;        ///< of its first sheet, among those of the block
};

struct DualBlock {
    std::uint64_t code = 0;
    RankedSet<24> edges;                  ///< crossed edges of its own
    RankedSet<8> cell_set;                ///< crossed cells of its own
    std::pmr::vector<double> roots;       ///< t of the inside ends, by rank of the edge
    std::pmr::vector<Vec3> normals;       ///< outward; zero: unknown
    std::pmr::vector<double> attributes;  ///< edge after edge, those asked for; NaN where undefined
    std::pmr::vector<DualCell> cells;     ///< by rank
    /// Cubes of cells that may become one leaf, as far as the signs tell: bit i of entry k is the cube i, in
    /// x, y, z order, of side 2^(k + 1).
    std::array<std::uint64_t, 3> mergeable{};
    /// Those that did, and hold a surface.
    std::array<std::uint64_t, 3> merged{};
    /// The vertices of its leaves, in the arrays of all blocks: positions in cells from the lower corner of
    /// the leaf, normals outward (zero: unknown).
    std::span<Vec3> vertices, vertex_normals;
    std::pmr::vector<double> vertex_attributes;
    /// Cells with wishes (by rank), and where their vertices belong.
    struct Wish {
        std::uint32_t cell = 0;
        Vec3 position;
    };
    std::pmr::vector<Wish> wishes;
    RankedSet<24> kept_edges;  ///< edges whose crossing is a vertex of the mesh

    /// As new, for the block with this code; keeps its memory.
    void reset(std::uint64_t new_code);
};

/// Blocks whose memory belongs to an arena that lives longer.
struct DestroyBlock {
    void operator()(DualBlock* block) const { std::destroy_at(block); }
};
using StoredBlock = std::unique_ptr<DualBlock, DestroyBlock>;
/// A copy of what the sampler made of a block, in `memory`, exactly as large as needed.
StoredBlock store(const DualBlock& block, std::pmr::memory_resource& memory);

struct DualOptions {
    bool cap = false;
    std::size_t attributes = 0;  ///< to take at the crossings, at most the field's attribute_count()
    double margin = 1e-4;        ///< least distance of vertices from the sides of their leaf, in cells
    double tolerance = 0;        ///< leaves merge where the surface stays this near, in cells; 0: never
};

/// Takes samples and crossings of blocks, one after the other; keeps its scratch memory between them.
class DualSampler {
  public:
    DualSampler(const Grid& grid, const DualOptions& options) : grid_(grid), options_(options) {}

    /// The block with this code, without vertices, until the next call; null when nothing crosses it. The
    /// fields are the field itself or what stands for it in the closed box of the block (block_box of
    /// block.h): the one for signs is asked at the corners of cells, the part for roots and gradients. Adds
    /// to the tallies below.
    const DualBlock* sample(std::uint64_t code, const BlockFields& fields);

    PlaceTally undefined;
    PlaceTally tight;   ///< cells, see ContourResult::tight_cells
    PlaceTally hidden;  ///< cells, see ContourResult::hidden_cells
    std::array<bool, 6> touches{};

  private:
    static constexpr std::uint32_t side = block_side + 1;
    static constexpr std::uint32_t size = side * side * side;
    static constexpr std::array<std::uint32_t, 3> stride{1, side, side* side};

    static std::uint32_t index(const Lattice& l) { return l[0] + l[1] * stride[1] + l[2] * stride[2]; }
    bool is_layer(const Lattice& l) const;
    bool is_inside(const Lattice& l) const { return (rows_[l[2] * side + l[1]] >> l[0] & 1) != 0; }
    Vec3 point(const Lattice& l) const;

    void place(std::uint64_t code);
    bool take_values(std::uint64_t code, SampledField& field);
    void look_between(std::uint64_t code, const BlockFields& fields);
    void note_samples(std::uint64_t code);
    void collect_edges(DualBlock& block);
    void add_edge(DualBlock& block, const Lattice& lower, std::size_t axis);
    void take_normals(DualBlock& block, SampledField& part);
    void take_attributes(DualBlock& block, SampledField& field);
    void collect_cells(DualBlock& block);
    unsigned signs_at(const Lattice& lower, std::uint32_t step) const;
    void find_mergeable(DualBlock& block);
    bool keeps_topology(const Lattice& lower, std::uint32_t step) const;

    const Grid& grid_;
    DualOptions options_;
    Lattice lo_{};              ///< first sample of the block, with layer
    Lattice first_{}, last_{};  ///< local samples that are no layer
    bool is_at_side_ = false;   ///< holds samples of a side of the box
    std::array<double, size> values_{};
    std::array<std::uint32_t, side * side> rows_{};  ///< bit x of row y + z * side: the sample is inside
    std::vector<double> x_, y_, z_, out_, gx_, gy_, gz_, columns_;
    DualBlock work_;
    EdgeRoots finder_;
    ThinParts thin_parts_;
    std::vector<CrossedEdge> crossed_;       ///< the edges to search
    std::vector<std::uint32_t> crossed_at_;  ///< their rank in the block
    std::vector<EdgeRoot> found_;
};

}  // namespace frep::contouring
