// One block of the lattice: samples, edge nodes and polygons of its cells. A block owns the edges whose
// lower sample is among its 8^3 samples; its cells also use edges of the next blocks, named by references
// that contour.cpp resolves. So every node is computed once, and a mesh of any size is built from independent
// parts. Tested by tests/unit/contour/contour_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "frep/contour/grid.h"
#include "frep/contour/octree.h"
#include "frep/eval/sampled_field.h"

namespace frep::contouring {

/// Edges of a block: local sample (z * 8 + y) * 8 + x, times 3, plus the axis.
inline constexpr std::uint32_t edges_a_block = block_side * block_side * block_side * 3;
/// One node of a polygon: an edge of this block or of one of the next blocks.
struct PolygonNode {
    std::uint16_t edge = 0;      ///< edge of the block `neighbour`
    std::uint8_t neighbour = 0;  ///< bits: the next block in x, y, z
    std::uint8_t cell_edge : 7;  ///< its number in the cell, 0..11
    std::uint8_t is_last : 1;    ///< the polygon ends with this node
};

/// The part of a mesh that a block makes: its edge nodes, in the order of `edges`, and polygons cell by cell.
/// A zero normal means: take the mean of the triangles' normals.
struct BlockMesh {
    std::vector<std::uint16_t> edges;  ///< ascending
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<double> attributes;  ///< node after node, those asked for; NaN where undefined
    std::vector<PolygonNode> polygons;
};

/// The box around all samples of the cells of the block with this code.
Box3 block_box(const Grid& grid, std::uint64_t code);

/// -gradient / |gradient|, the outward unit normal; the zero vector if the gradient is zero or not finite.
Vec3 outward_normal(Vec3 gradient);

struct BlockOptions {
    bool cap = false;
    std::size_t attributes = 0;  ///< attributes to take at the nodes, at most the field's attribute_count()
};

/// Contours blocks, one after the other; keeps its scratch memory between them. Serves one thread.
class BlockContourer {
  public:
    BlockContourer(const Grid& grid, SampledField& field, const BlockOptions& options)
        : grid_(grid), field_(field), part_(&field), options_(options) {}

    /// The mesh of the block with this code; null when there is none. Adds to the tallies below. `part`
    /// stands for the field in block_box(); it may be the field itself.
    std::unique_ptr<BlockMesh> contour(std::uint64_t code, SampledField& part);

    PlaceTally undefined;
    std::array<bool, 6> touches{};

  private:
    static constexpr std::uint32_t lattice_side = block_side + 1;
    static constexpr std::uint32_t lattice_size = lattice_side * lattice_side * lattice_side;
    static constexpr std::array<std::uint32_t, 3> stride{1, lattice_side, lattice_side* lattice_side};
    using Local = std::array<std::uint32_t, 3>;  ///< sample of the lattice, 0..8

    /// Edges of one direction being bisected, column by column. The bracket is kept as parameters 0..1.
    struct Brackets {
        std::vector<Vec3> lower;              ///< lower ends
        std::vector<double> start, end;       ///< coordinates of the two ends, along the axis
        std::vector<double> length;           ///< end - start
        std::vector<double> inside, outside;  ///< ends of the bracket
        std::vector<std::uint8_t> wall;       ///< 1: the outside end is undefined
        std::vector<std::uint32_t> node;      ///< its place in mesh_
        void clear();
        std::size_t size() const { return node.size(); }
    };

    static std::uint32_t lattice_index(const Local& l) {
        return l[0] * stride[0] + l[1] * stride[1] + l[2] * stride[2];
    }
    std::uint32_t with_layer(std::size_t axis, std::uint32_t local) const { return lo_[axis] + local; }
    bool is_layer(std::size_t axis, std::uint32_t local) const {
        const std::uint32_t e = with_layer(axis, local);
        return e == 0 || e > grid_.cells[axis] + 1;
    }
    bool is_layer(const Local& l) const {
        return is_layer(0, l[0]) || is_layer(1, l[1]) || is_layer(2, l[2]);
    }
    Vec3 sample_point(const Local& l) const;

    void place(std::uint64_t code);
    bool sample(std::uint64_t code);
    void note_samples(std::uint64_t code);
    void note_inside(const Local& l);
    void collect_nodes();
    void add_node(const Local& lower, std::size_t axis);
    void add_cap_node(const Local& inside);
    void take_attributes();
    /// The edge whose node closes the shape at an inside sample of the box's boundary: its lower end and
    /// axis.
    Local cap_edge(const Local& inside, std::size_t& axis) const;
    void bisect();
    void set_middles(std::size_t axis, std::size_t first);
    void set_positions();
    void take_normals();
    void add_cells();
    /// A layer cell at an edge or a corner of the box: its nodes all lie on the edge, so it makes no polygon.
    bool is_flat_cell(const Local& cell) const;
    void add_cell(const Local& corner);
    void take_whole_values(const Local& corner, std::array<double, 8>& values);
    PolygonNode polygon_node(const Local& cell, std::uint8_t cell_edge) const;
    std::vector<double>& column(std::size_t axis) { return axis == 0 ? x_ : axis == 1 ? y_ : z_; }

    const Grid& grid_;
    SampledField& field_;  ///< has the attributes
    SampledField* part_;   ///< F, in the present block
    BlockOptions options_;

    Local lo_{};               ///< first sample of the block, with layer
    Local first_{}, last_{};   ///< local samples that are no layer
    bool is_at_side_ = false;  ///< holds samples of a side of the box
    std::array<double, lattice_size> values_{};
    std::array<std::uint8_t, lattice_size> inside_{};
    std::vector<double> x_, y_, z_, out_, gx_, gy_, gz_;
    std::array<Brackets, 3> brackets_;
    std::vector<std::uint32_t> cap_nodes_;  ///< nodes that are samples
    std::vector<double> attribute_columns_;
    BlockMesh mesh_;  ///< being built; keeps its memory
};

}  // namespace frep::contouring
