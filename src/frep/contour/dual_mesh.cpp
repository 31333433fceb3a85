// Implementation of dual_mesh.h: vertices of leaves, then what becomes of each edge, then the triangles. Each
// pass works on the blocks independently and writes to their own slots.
#include "frep/contour/dual_mesh.h"

#include <algorithm>
#include <atomic>

#include "frep/base/parallel.h"
#include "frep/contour/dual_edge.h"

namespace frep::contouring {

namespace {

constexpr std::size_t blocks_a_task = 32;
/// Without a tolerance, crossings farther than this from the mesh stay vertices, in cells.
constexpr double keep_distance = 0.05;
constexpr std::uint64_t vertex_limit = 0xffffff00u;

using State = EdgeStar::State;

class Joiner {
  public:
    Joiner(const Grid& grid, const DualOptions& options, std::vector<std::unique_ptr<DualBlock>> blocks,
           const Job& job)
        : grid_(grid), options_(options), job_(job), blocks_(std::move(blocks)), index_(blocks_) {}

    Result<DualMesh> run() {
        for_blocks([this](std::uint32_t begin, std::uint32_t end) { make_vertices(begin, end); });
        if (job_.cancelled()) return cancelled();
        if (contradiction_) return contradiction();
        for_blocks([this](std::uint32_t begin, std::uint32_t end) { grant_wishes(begin, end); });
        if (job_.cancelled()) return cancelled();
        if (!number_leaves()) return too_many();
        for_blocks([this](std::uint32_t begin, std::uint32_t end) { decide_edges(begin, end); });
        if (job_.cancelled()) return cancelled();
        if (contradiction_) return contradiction();
        if (!number_edges()) return too_many();
        copy_vertices();
        make_triangles();
        if (job_.cancelled()) return cancelled();
        blocks_.clear();
        fill_missing_normals();
        return std::move(result_);
    }

  private:
    static Error cancelled() { return {ErrorKind::cancelled, "contouring was cancelled"}; }
    static Error too_many() {
        return {ErrorKind::over_limit, "the mesh has more vertices than a 32-bit index can name"};
    }
    static Error contradiction() {
        return {ErrorKind::invalid_argument,
                "the intervals of the field contradict its values; contour without pruning"};
    }

    std::size_t tasks() const { return (blocks_.size() + blocks_a_task - 1) / blocks_a_task; }

    template <class Body>
    void for_blocks(Body body) {
        parallel_for(job_, tasks(), [&](std::size_t t) {
            const std::size_t end = std::min((t + 1) * blocks_a_task, blocks_.size());
            body(static_cast<std::uint32_t>(t * blocks_a_task), static_cast<std::uint32_t>(end));
        });
    }

    void make_vertices(std::uint32_t begin, std::uint32_t end) {
        DualVertices vertices(options_);
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::array<std::uint32_t, 27> around = index_.around(i);
            NextBlocks next{};
            for (std::size_t n = 0; n < 8; ++n) {
                const std::uint32_t b = around[13 + (n & 1) + 3 * (n >> 1 & 1) + 9 * (n >> 2)];
                next[n] = b == BlockIndex::none ? nullptr : blocks_[b].get();
            }
            if (!vertices.make(*blocks_[i], next)) contradiction_ = true;
        }
    }

    void grant_wishes(std::uint32_t begin, std::uint32_t end) {
        const DualVertices vertices(options_);
        for (std::uint32_t i = begin; i < end; ++i) {
            if (blocks_[i]->wishes.empty()) continue;
            const std::array<std::uint32_t, 27> ranks = index_.around(i);
            std::array<const DualBlock*, 27> around{};
            for (std::size_t n = 0; n < 27; ++n) {
                if (ranks[n] != BlockIndex::none) around[n] = blocks_[ranks[n]].get();
            }
            vertices.grant_wishes(*blocks_[i], around, grid_.cells);
        }
    }

    bool number_leaves() {
        std::uint64_t total = 0;
        for (const auto& block : blocks_) {
            first_leaf_.push_back(static_cast<std::uint32_t>(total));
            total += block->vertices.size();
            if (total >= vertex_limit) return false;
        }
        leaves_ = static_cast<std::uint32_t>(total);
        return true;
    }

    Surroundings surroundings(std::uint32_t i) const {
        Surroundings s;
        s.ranks = index_.around(i);
        for (std::size_t n = 0; n < 27; ++n) {
            if (s.ranks[n] == BlockIndex::none) continue;
            s.blocks[n] = blocks_[s.ranks[n]].get();
            s.first_vertex[n] = first_leaf_[s.ranks[n]];
        }
        s.lo = morton_decode(blocks_[i]->code);
        for (std::uint32_t& lo : s.lo) lo *= block_side;
        s.cells = grid_.cells;
        s.cap = options_.cap;
        s.margin = options_.margin;
        s.keep_distance = options_.tolerance > 0 ? options_.tolerance : keep_distance;
        return s;
    }

    /// Calls visit(star, number, rank) for every edge of block i.
    template <class Visit>
    void for_edges(std::uint32_t i, EdgeStar& star, Visit visit) {
        const DualBlock& block = *blocks_[i];
        std::uint32_t rank = 0;
        for (std::uint32_t w = 0; w < block.edges.bits.size(); ++w) {
            for (std::uint64_t left = block.edges.bits[w]; left != 0; left &= left - 1) {
                const std::uint32_t number = w * 64 + static_cast<std::uint32_t>(std::countr_zero(left));
                if (!star.look(number)) {
                    contradiction_ = true;
                    return;
                }
                visit(number, rank++);
            }
        }
    }

    void decide_edges(std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i) {
            DualBlock& block = *blocks_[i];
            const Surroundings around = surroundings(i);
            EdgeStar star(around);
            block.edge_states.assign(block.roots.size(), 0);
            for_edges(i, star, [&](std::uint32_t number, std::uint32_t rank) {
                const std::uint8_t state = star.state();
                block.edge_states[rank] = state;
                if (state & State::kept) block.kept_edges.insert(number);
            });
            block.kept_edges.count();
        }
    }

    bool number_edges() {
        std::uint64_t total = 0;
        for (const auto& block : blocks_) {
            first_edge_.push_back(static_cast<std::uint32_t>(total));
            for (const std::uint64_t word : block->kept_edges.bits)
                total += static_cast<std::uint64_t>(std::popcount(word));
            if (total + leaves_ >= vertex_limit) return false;
        }
        result_.edge_vertices = static_cast<std::size_t>(total);
        return true;
    }

    /// The coordinate of sample e, with layer; e may have a part of a cell.
    double coordinate(std::size_t axis, double e) const {
        const Vec3& o = grid_.origin;
        return (axis == 0 ? o.x : axis == 1 ? o.y : o.z) + (e - 1) * grid_.cell;
    }

    Vec3 edge_point(const Lattice& lo, std::uint32_t number, double t) const {
        const Lattice local = local_of(number / 3);
        const double held = std::min(std::max(t, options_.margin), 1 - options_.margin);
        std::array<double, 3> p{};
        for (std::size_t a = 0; a < 3; ++a) {
            const auto e = static_cast<double>(lo[a] + local[a]);
            p[a] = coordinate(a, e);
            if (a == number % 3) p[a] += held * (coordinate(a, e + 1) - p[a]);
        }
        return {p[0], p[1], p[2]};
    }

    void copy_vertices() {
        const std::size_t wanted = options_.attributes, edges = result_.edge_vertices;
        Mesh& mesh = result_.mesh;
        mesh.vertices.resize(edges + leaves_);
        mesh.normals.resize(edges + leaves_);
        result_.attributes.assign(wanted, std::vector<double>(edges + leaves_));
        for_blocks([&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) {
                copy_edges(i);
                copy_leaves(i);
            }
        });
    }

    void copy_edges(std::uint32_t i) {
        const DualBlock& block = *blocks_[i];
        Lattice lo = morton_decode(block.code);
        for (std::uint32_t& l : lo) l *= block_side;
        std::size_t to = first_edge_[i];
        for (std::uint32_t w = 0; w < block.kept_edges.bits.size(); ++w) {
            for (std::uint64_t left = block.kept_edges.bits[w]; left != 0; left &= left - 1, ++to) {
                const std::uint32_t number = w * 64 + static_cast<std::uint32_t>(std::countr_zero(left));
                const std::uint32_t rank = block.edges.rank(number);
                result_.mesh.vertices[to] = edge_point(lo, number, block.roots[rank]);
                result_.mesh.normals[to] = block.normals[rank];
                for (std::size_t k = 0; k < options_.attributes; ++k)
                    result_.attributes[k][to] = block.attributes[rank * options_.attributes + k];
            }
        }
    }

    void copy_leaves(std::uint32_t i) {
        const DualBlock& block = *blocks_[i];
        Lattice lo = morton_decode(block.code);
        for (std::uint32_t& l : lo) l *= block_side;
        std::size_t to = result_.edge_vertices + first_leaf_[i];
        for (std::size_t v = 0; v < block.vertices.size(); ++v, ++to) {
            const Vec3& p = block.vertices[v].position;
            result_.mesh.vertices[to] = {coordinate(0, lo[0] + p.x), coordinate(1, lo[1] + p.y),
                                         coordinate(2, lo[2] + p.z)};
            result_.mesh.normals[to] = block.vertices[v].normal;
            for (std::size_t k = 0; k < options_.attributes; ++k)
                result_.attributes[k][to] = block.vertex_attributes[v * options_.attributes + k];
        }
    }

    void make_triangles() {
        std::vector<std::vector<Triangle>> parts(tasks());
        for_blocks([&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) cut_block(i, parts[begin / blocks_a_task]);
        });
        std::size_t total = 0;
        for (const auto& part : parts) total += part.size();
        result_.mesh.triangles.reserve(total);
        for (std::vector<Triangle>& part : parts) {
            result_.mesh.triangles.insert(result_.mesh.triangles.end(), part.begin(), part.end());
            part = {};
        }
    }

    void cut_block(std::uint32_t i, std::vector<Triangle>& out) {
        const Surroundings around = surroundings(i);
        EdgeStar star(around);
        for_edges(i, star, [&](std::uint32_t number, std::uint32_t rank) {
            const std::uint8_t state = blocks_[i]->edge_states[rank];
            if (state & State::dead) return;
            if (state & State::kept) {
                add_fan(i, around, star, number, state, out);
            } else {
                add_polygon(star, state, out);
            }
        });
    }

    std::uint32_t leaf_vertex(const EdgeStar& star, std::size_t quadrant) const {
        return static_cast<std::uint32_t>(result_.edge_vertices) + star.vertex(quadrant);
    }

    std::uint32_t edge_vertex(std::uint32_t block, std::uint32_t number) const {
        return first_edge_[block] + blocks_[block]->kept_edges.rank(number);
    }

    /// a b c, counter-clockwise seen from the upper end of the edge, turned over if that is the inside.
    static void add(const EdgeStar& star, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                    std::vector<Triangle>& out) {
        if (star.lower_is_inside()) {
            out.push_back({a, b, c});
        } else {
            out.push_back({a, c, b});
        }
    }

    /// The triangles around a crossing that is a vertex. Those of an arc that is not turned are made at that
    /// end of it that comes first.
    void add_fan(std::uint32_t i, const Surroundings& around, const EdgeStar& star, std::uint32_t number,
                 std::uint8_t state, std::vector<Triangle>& out) const {
        const std::uint32_t here = edge_vertex(i, number);
        for (std::size_t q = 0; q < 4; ++q) {
            const std::size_t next = (q + 1) % 4;
            const bool has_q = star.vertex(q) != EdgeStar::no_vertex;
            const bool has_next = star.vertex(next) != EdgeStar::no_vertex;
            if (star.is_one_leaf(q) || !(has_q || has_next)) continue;
            if (state >> q & 1) {
                add(star, here, leaf_vertex(star, q), leaf_vertex(star, next), out);
                continue;
            }
            const EdgeName end = star.partner(q);
            const std::uint32_t block = around.ranks[end.block];
            if (block < i || (block == i && end.number < number)) continue;
            const std::uint32_t there = edge_vertex(block, end.number);
            if (has_q) add(star, here, leaf_vertex(star, q), there, out);
            if (has_next) add(star, here, there, leaf_vertex(star, next), out);
        }
    }

    void add_polygon(const EdgeStar& star, std::uint8_t state, std::vector<Triangle>& out) const {
        std::array<std::uint32_t, 4> c{};
        std::size_t count = 0;
        for (std::size_t q = 0; q < 4; ++q) {
            if (!star.is_one_leaf(q)) c[count++] = leaf_vertex(star, q);
        }
        if (count == 3) {
            add(star, c[0], c[1], c[2], out);
        } else if (state & State::second_diagonal) {
            add(star, c[0], c[1], c[3], out);
            add(star, c[1], c[2], c[3], out);
        } else {
            add(star, c[0], c[1], c[2], out);
            add(star, c[0], c[2], c[3], out);
        }
    }

    /// Normals that the gradient could not give: the mean of the triangles' normals; z where that vanishes.
    void fill_missing_normals() {
        Mesh& mesh = result_.mesh;
        const auto is_missing = [](Vec3 n) { return n == Vec3{0, 0, 0}; };
        if (std::none_of(mesh.normals.begin(), mesh.normals.end(), is_missing)) return;
        const std::vector<Vec3> means = mean_normals(mesh);
        for (std::size_t v = 0; v < means.size(); ++v) {
            if (!is_missing(mesh.normals[v])) continue;
            mesh.normals[v] = is_missing(means[v]) ? Vec3{0, 0, 1} : means[v];
        }
    }

    const Grid& grid_;
    DualOptions options_;
    const Job& job_;
    std::vector<std::unique_ptr<DualBlock>> blocks_;
    BlockIndex index_;
    std::vector<std::uint32_t> first_leaf_, first_edge_;
    std::uint32_t leaves_ = 0;
    DualMesh result_;
    std::atomic<bool> contradiction_{false};
};

std::uint64_t mixed(std::uint64_t code) {
    code *= 0x9e3779b97f4a7c15u;
    return code ^ code >> 32;
}

}  // namespace

BlockIndex::BlockIndex(const std::vector<std::unique_ptr<DualBlock>>& blocks) {
    table_.assign(std::bit_ceil(2 * blocks.size() + 1), none);
    codes_.reserve(blocks.size());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        codes_.push_back(blocks[i]->code);
        std::size_t at = mixed(codes_[i]) & (table_.size() - 1);
        while (table_[at] != none) at = (at + 1) & (table_.size() - 1);
        table_[at] = i;
    }
}

std::uint32_t BlockIndex::find(std::uint64_t code) const {
    std::size_t at = mixed(code) & (table_.size() - 1);
    while (table_[at] != none && codes_[table_[at]] != code) at = (at + 1) & (table_.size() - 1);
    return table_[at];
}

std::array<std::uint32_t, 27> BlockIndex::around(std::uint32_t i) const {
    const Lattice here = morton_decode(codes_[i]);
    std::array<std::uint32_t, 27> found{};
    for (std::uint32_t n = 0; n < 27; ++n) {
        const Lattice step{n % 3, n / 3 % 3, n / 9};
        Lattice at{};
        bool is_in = true;
        for (std::size_t a = 0; a < 3; ++a) {
            is_in = is_in && here[a] + step[a] >= 1;
            at[a] = here[a] + step[a] - 1;
        }
        found[n] = is_in ? find(morton_code(at)) : none;
    }
    return found;
}

Result<DualMesh> join_blocks(const Grid& grid, const DualOptions& options,
                             std::vector<std::unique_ptr<DualBlock>> blocks, const Job& job) {
    return Joiner(grid, options, std::move(blocks), job).run();
}

}  // namespace frep::contouring
