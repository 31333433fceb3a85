// Implementation of dual_mesh.h: vertices of leaves, then what becomes of each edge with the triangles of
// those that are taken out, then the triangles around the others. Each pass works on the blocks independently
// and writes to their own slots, most of them in the mesh itself.
#include "frep/contour/dual_mesh.h"

#include <algorithm>
#include <atomic>

#include "frep/base/large_pages.h"
#include "frep/base/parallel.h"
#include "frep/contour/block_index.h"
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
    Joiner(const Grid& grid, const DualOptions& options, std::vector<StoredBlock> blocks, const Job& job)
        : grid_(grid), options_(options), job_(job), blocks_(std::move(blocks)), index_(blocks_) {}

    Result<DualMesh> run() {
        if (!number_sheets()) return too_many();
        for_blocks([this](std::uint32_t begin, std::uint32_t end) { make_vertices(begin, end); });
        if (job_.cancelled()) return cancelled();
        if (contradiction_) return contradiction();
        if (options_.tolerance > 0) close_gaps();
        for_blocks([this](std::uint32_t begin, std::uint32_t end) { grant_wishes(begin, end); });
        if (job_.cancelled()) return cancelled();
        make_polygons();
        if (job_.cancelled()) return cancelled();
        if (contradiction_) return contradiction();
        if (!number_edges()) return too_many();
        place_vertices();
        make_fans();
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

    /// Room in the mesh for a vertex a sheet, and its place in the block.
    bool number_sheets() {
        std::uint64_t total = 0, crossings = 0;
        std::vector<std::uint32_t> counts;
        for (const auto& block : blocks_) {
            first_leaf_.push_back(static_cast<std::uint32_t>(total));
            first_crossing_.push_back(crossings);
            counts.push_back(DualVertices::number_sheets(*block));
            total += counts.back();
            crossings += block->roots.size();
            if (total >= vertex_limit) return false;
        }
        first_crossing_.push_back(crossings);
        leaves_ = static_cast<std::uint32_t>(total);
        make_room(total, crossings);
        Mesh& mesh = result_.mesh;
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            blocks_[i]->vertices = {mesh.vertices.data() + first_leaf_[i], counts[i]};
            blocks_[i]->vertex_normals = {mesh.normals.data() + first_leaf_[i], counts[i]};
        }
        return true;
    }

    /// The arrays of the mesh. Their memory is asked for before any of it is written, so that it lies side by
    /// side and fills large pages.
    void make_room(std::size_t leaves, std::size_t crossings) {
        Mesh& mesh = result_.mesh;
        const std::size_t vertices = leaves + leaves / 8;  // most crossings are taken out
        const std::size_t triangles = 2 * crossings + crossings / 8;
        mesh.vertices.reserve(vertices);
        mesh.normals.reserve(vertices);
        mesh.triangles.reserve(triangles);
        expect_to_fill(mesh.vertices.data(), vertices * sizeof(Vec3));
        expect_to_fill(mesh.normals.data(), vertices * sizeof(Vec3));
        expect_to_fill(mesh.triangles.data(), triangles * sizeof(Triangle));
        mesh.vertices.resize(leaves);
        mesh.normals.resize(leaves);
        mesh.triangles.resize(2 * crossings);
    }

    /// Moves the vertices up where leaves merged.
    void close_gaps() {
        std::uint32_t to = 0;
        Mesh& mesh = result_.mesh;
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            DualBlock& block = *blocks_[i];
            const std::size_t count = block.vertices.size();
            std::copy_n(block.vertices.data(), count, mesh.vertices.data() + to);
            std::copy_n(block.vertex_normals.data(), count, mesh.normals.data() + to);
            block.vertices = {mesh.vertices.data() + to, count};
            block.vertex_normals = {mesh.normals.data() + to, count};
            first_leaf_[i] = to;
            to += static_cast<std::uint32_t>(count);
        }
        leaves_ = to;
        mesh.vertices.resize(to);
        mesh.normals.resize(to);
    }

    Surroundings surroundings(std::uint32_t i) const {
        Surroundings s;
        s.ranks = index_.around(i);
        for (std::size_t n = 0; n < 27; ++n) {
            if (s.ranks[n] == BlockIndex::none) continue;
            s.blocks[n] = blocks_[s.ranks[n]].get();
            s.first_vertex[n] = first_leaf_[s.ranks[n]];
        }
        s.lo = first_sample(*blocks_[i]);
        s.cells = grid_.cells;
        s.cap = options_.cap;
        s.is_inner = true;
        for (std::size_t a = 0; a < 3; ++a)
            s.is_inner = s.is_inner && s.lo[a] >= block_side && s.lo[a] + block_side <= grid_.cells[a];
        s.margin = options_.margin;
        s.keep_distance = options_.tolerance > 0 ? options_.tolerance : keep_distance;
        return s;
    }

    /// What becomes of each edge, and the triangles of those that are taken out. Each task has room for all
    /// that its edges can make; then the parts move together.
    void make_polygons() {
        std::vector<Triangle>& triangles = result_.mesh.triangles;
        fans_.resize(tasks());
        std::vector<std::size_t> counts(tasks());
        for_blocks([&](std::uint32_t begin, std::uint32_t end) {
            DualRegion region;
            Triangle* const first = triangles.data() + 2 * first_crossing_[begin];
            Triangle* out = first;
            for (std::uint32_t i = begin; i < end; ++i) decide_edges(i, region, out);
            counts[begin / blocks_a_task] = static_cast<std::size_t>(out - first);
        });
        std::size_t to = 0;
        for (std::size_t t = 0; t < tasks(); ++t) {
            const std::size_t from = 2 * first_crossing_[t * blocks_a_task];
            if (to != from) std::copy_n(triangles.data() + from, counts[t], triangles.data() + to);
            to += counts[t];
        }
        triangles.resize(to);
    }

    void decide_edges(std::uint32_t i, DualRegion& region, Triangle*& out) {
        DualBlock& block = *blocks_[i];
        if (block.roots.empty()) return;
        const Surroundings around = surroundings(i);
        region.fill(around);
        EdgeStar star(around, region);
        std::uint32_t rank = 0;
        for (std::uint32_t w = 0; w < block.edges.bits.size(); ++w) {
            for (std::uint64_t left = block.edges.bits[w]; left != 0; left &= left - 1, ++rank) {
                const std::uint32_t number = w * 64 + static_cast<std::uint32_t>(std::countr_zero(left));
                if (!star.look(number, block.roots[rank])) {
                    contradiction_ = true;
                    return;
                }
                const std::uint8_t state = star.state();
                if (state & State::kept) {
                    block.kept_edges.insert(number);
                    fans_[i / blocks_a_task].push_back(fan_of(star, state, around, i, number));
                } else if (!(state & State::dead)) {
                    add_polygon(star, state, out);
                }
            }
        }
        block.kept_edges.count();
    }

    /// The triangles around a crossing that is a vertex, before all vertices have numbers.
    struct Fan {
        /// An end of an arc.
        struct End {
            std::uint32_t block = 0, number = 0;
        };
        End here;
        bool lower_is_inside = false;
        std::uint8_t turned = 0, open = 0;  ///< bits: arcs that are turned, that are not
        std::array<std::uint32_t, 4> vertices{};
        std::array<End, 4> ends{};  ///< the other ends of open arcs
    };

    static Fan fan_of(const EdgeStar& star, std::uint8_t state, const Surroundings& around, std::uint32_t i,
                      std::uint32_t number) {
        Fan fan;
        fan.here = {i, number};
        fan.lower_is_inside = star.lower_is_inside();
        for (std::size_t q = 0; q < 4; ++q) fan.vertices[q] = star.vertex(q);
        for (std::size_t q = 0; q < 4; ++q) {
            const std::uint32_t next = fan.vertices[(q + 1) % 4];
            if (star.is_one_leaf(q) || (fan.vertices[q] & next) == EdgeStar::no_vertex) continue;
            if (state >> q & 1) {
                fan.turned = static_cast<std::uint8_t>(fan.turned | 1u << q);
            } else {
                const EdgeName end = star.partner(q);
                fan.open = static_cast<std::uint8_t>(fan.open | 1u << q);
                fan.ends[q] = {around.ranks[end.block], end.number};
            }
        }
        return fan;
    }

    bool number_edges() {
        std::uint64_t total = 0;
        for (const auto& block : blocks_) {
            first_edge_.push_back(static_cast<std::uint32_t>(total));
            for (const std::uint64_t word : block->kept_edges.bits) total += bit_count(word);
            if (total + leaves_ >= vertex_limit) return false;
        }
        edges_ = static_cast<std::size_t>(total);
        return true;
    }

    /// The first sample of a block, with layer.
    static Lattice first_sample(const DualBlock& block) {
        Lattice lo = morton_decode(block.code);
        for (std::uint32_t& l : lo) l *= block_side;
        return lo;
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

    /// The positions of all vertices in the model, and the attributes.
    void place_vertices() {
        const std::size_t wanted = options_.attributes, count = edges_ + leaves_;
        result_.mesh.vertices.resize(count);
        result_.mesh.normals.resize(count);
        result_.attributes.assign(wanted, std::vector<double>(count));
        for_blocks([&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) {
                place_edges(i);
                place_leaves(i);
            }
        });
    }

    void place_edges(std::uint32_t i) {
        const DualBlock& block = *blocks_[i];
        const Lattice lo = first_sample(block);
        std::size_t to = leaves_ + first_edge_[i];
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

    void place_leaves(std::uint32_t i) {
        const DualBlock& block = *blocks_[i];
        const Lattice lo = first_sample(block);
        const std::size_t first = first_leaf_[i], count = block.vertices.size();
        std::uint32_t next = 0;  // cells of one leaf come back to a vertex that was before
        for (const DualCell& cell : block.cells) {
            if (cell.vertex < next) continue;
            const Lattice local = local_of(cell.number);
            std::array<double, 3> corner{};
            for (std::size_t a = 0; a < 3; ++a)
                corner[a] = static_cast<double>(lo[a] + (local[a] >> cell.level << cell.level));
            const std::uint32_t sheets = cell.level > 0 ? 1u : cell_pattern(cell.signs).sheets;
            next = cell.vertex + sheets;
            for (std::size_t v = first + cell.vertex; v < first + next; ++v) {
                Vec3& p = result_.mesh.vertices[v];
                p = {coordinate(0, corner[0] + p.x), coordinate(1, corner[1] + p.y),
                     coordinate(2, corner[2] + p.z)};
            }
        }
        for (std::size_t v = 0; v < count; ++v) {
            for (std::size_t k = 0; k < options_.attributes; ++k)
                result_.attributes[k][first + v] = block.vertex_attributes[v * options_.attributes + k];
        }
    }

    void make_fans() {
        std::vector<std::vector<Triangle>> parts(tasks());
        for_blocks([&](std::uint32_t begin, std::uint32_t) {
            const std::size_t t = begin / blocks_a_task;
            for (const Fan& fan : fans_[t]) add_fan(fan, parts[t]);
        });
        std::size_t total = result_.mesh.triangles.size();
        for (const std::vector<Triangle>& part : parts) total += part.size();
        result_.mesh.triangles.reserve(total);
        for (const std::vector<Triangle>& part : parts)
            result_.mesh.triangles.insert(result_.mesh.triangles.end(), part.begin(), part.end());
    }

    std::uint32_t edge_vertex(const Fan::End& end) const {
        return leaves_ + first_edge_[end.block] + blocks_[end.block]->kept_edges.rank(end.number);
    }

    /// a b c, counter-clockwise seen from the upper end of the edge, turned over if that is the inside.
    static Triangle oriented(bool lower_is_inside, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return lower_is_inside ? Triangle{a, b, c} : Triangle{a, c, b};
    }

    /// The triangles of an arc that is not turned are made at that end of it that comes first.
    void add_fan(const Fan& fan, std::vector<Triangle>& out) const {
        const std::uint32_t here = edge_vertex(fan.here);
        const bool lower = fan.lower_is_inside;
        for (std::size_t q = 0; q < 4; ++q) {
            const std::uint32_t a = fan.vertices[q], b = fan.vertices[(q + 1) % 4];
            if (fan.turned >> q & 1) out.push_back(oriented(lower, here, a, b));
            if (!(fan.open >> q & 1)) continue;
            const Fan::End& end = fan.ends[q];
            if (end.block < fan.here.block || (end.block == fan.here.block && end.number < fan.here.number))
                continue;
            const std::uint32_t there = edge_vertex(end);
            if (a != EdgeStar::no_vertex) out.push_back(oriented(lower, here, a, there));
            if (b != EdgeStar::no_vertex) out.push_back(oriented(lower, here, there, b));
        }
    }

    static void add_polygon(const EdgeStar& star, std::uint8_t state, Triangle*& out) {
        std::array<std::uint32_t, 4> c{};
        std::size_t count = 0;
        for (std::size_t q = 0; q < 4; ++q) {
            if (!star.is_one_leaf(q)) c[count++] = star.vertex(q);
        }
        const bool lower = star.lower_is_inside();
        if (count == 3) {
            *out++ = oriented(lower, c[0], c[1], c[2]);
        } else if (state & State::second_diagonal) {
            *out++ = oriented(lower, c[0], c[1], c[3]);
            *out++ = oriented(lower, c[1], c[2], c[3]);
        } else {
            *out++ = oriented(lower, c[0], c[1], c[2]);
            *out++ = oriented(lower, c[0], c[2], c[3]);
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
    std::vector<StoredBlock> blocks_;
    std::vector<std::vector<Fan>> fans_;  ///< by task
    BlockIndex index_;
    std::vector<std::uint32_t> first_leaf_, first_edge_;  ///< vertices, by block
    std::vector<std::size_t> first_crossing_;             ///< and an end
    std::uint32_t leaves_ = 0;
    std::size_t edges_ = 0;  ///< vertices on edges
    DualMesh result_;
    std::atomic<bool> contradiction_{false};
};

}  // namespace

Result<DualMesh> join_blocks(const Grid& grid, const DualOptions& options, std::vector<StoredBlock> blocks,
                             const Job& job) {
    return Joiner(grid, options, std::move(blocks), job).run();
}

}  // namespace frep::contouring
