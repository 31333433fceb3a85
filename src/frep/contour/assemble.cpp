// Implementation of assemble.h: thesis 1.5.3, the polygons cut into triangles, once all nodes have a number.
#include "frep/contour/assemble.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "frep/base/parallel.h"
#include "frep/contour/cell.h"

namespace frep::contouring {

namespace {

constexpr std::size_t blocks_a_task = 32;
constexpr std::uint32_t no_vertex = 0xffffffffu;

/// The triangles of some blocks. Indices from `nodes` on name middle vertices of this task.
struct TaskTriangles {
    std::vector<Triangle> triangles;
    std::vector<Vec3> middles;
    std::vector<Vec3> middle_normals;
    std::vector<std::vector<double>> middle_attributes;  ///< columns
};

class Assembly {
  public:
    Assembly(const std::vector<std::uint64_t>& codes, std::vector<std::unique_ptr<BlockMesh>> parts,
             std::size_t attributes, FieldPool& fields, const Job& job)
        : fields_(fields), job_(job), attributes_(attributes) {
        for (std::size_t i = 0; i < codes.size(); ++i) {
            if (!parts[i]) continue;
            codes_.push_back(codes[i]);
            parts_.push_back(std::move(parts[i]));
        }
    }

    Result<AssembledMesh> run() {
        if (!number_nodes()) {
            return Error{ErrorKind::over_limit, "the mesh has more vertices than a 32-bit index can name"};
        }
        copy_nodes();
        std::vector<TaskTriangles> tasks((parts_.size() + blocks_a_task - 1) / blocks_a_task);
        parallel_for(job_, tasks.size(), [&](std::size_t t) { cut_polygons(t, tasks[t]); });
        if (job_.cancelled()) return Error{ErrorKind::cancelled, "contouring was cancelled"};
        if (contradiction_) {
            return Error{ErrorKind::invalid_argument,
                         "the intervals of the field contradict its values; contour without pruning"};
        }
        parts_.clear();
        if (!append_triangles(tasks)) {
            return Error{ErrorKind::over_limit, "the mesh has more vertices than a 32-bit index can name"};
        }
        fill_missing_normals();
        return AssembledMesh{std::move(mesh_), nodes_, std::move(attributes_)};
    }

  private:
    /// The first vertex of each block.
    bool number_nodes() {
        std::uint64_t total = 0;
        for (const auto& part : parts_) {
            bases_.push_back(static_cast<std::uint32_t>(total));
            total += part->edges.size();
            if (total >= no_vertex) return false;
        }
        nodes_ = static_cast<std::uint32_t>(total);
        return true;
    }

    void copy_nodes() {
        mesh_.vertices.reserve(nodes_);
        mesh_.normals.reserve(nodes_);
        for (const auto& part : parts_) {
            mesh_.vertices.insert(mesh_.vertices.end(), part->positions.begin(), part->positions.end());
            mesh_.normals.insert(mesh_.normals.end(), part->normals.begin(), part->normals.end());
            part->positions = {};
            part->normals = {};
        }
        const std::size_t wanted = attributes_.size();
        for (std::size_t k = 0; k < wanted; ++k) {
            attributes_[k].reserve(nodes_);
            for (const auto& part : parts_) {
                for (std::size_t i = k; i < part->attributes.size(); i += wanted)
                    attributes_[k].push_back(part->attributes[i]);
            }
        }
        for (const auto& part : parts_) part->attributes = {};
    }

    /// The blocks that the nodes of block i may lie in: itself and the next ones; -1 where there is none.
    std::array<std::ptrdiff_t, 8> neighbours_of(std::size_t i) const {
        const std::array<std::uint32_t, 3> here = morton_decode(codes_[i]);
        std::array<std::ptrdiff_t, 8> found{};
        for (std::uint32_t n = 0; n < 8; ++n) {
            const std::uint64_t code =
                morton_code({here[0] + (n & 1u), here[1] + (n >> 1 & 1u), here[2] + (n >> 2)});
            const auto at = std::lower_bound(codes_.begin(), codes_.end(), code);
            found[n] = at != codes_.end() && *at == code ? at - codes_.begin() : -1;
        }
        return found;
    }

    /// The vertices of block i's own edges by edge number.
    std::array<std::uint32_t, edges_a_block> own_vertices(std::size_t i) const {
        std::array<std::uint32_t, edges_a_block> table;
        table.fill(no_vertex);
        std::uint32_t v = bases_[i];
        for (const std::uint16_t edge : parts_[i]->edges) table[edge] = v++;
        return table;
    }

    std::uint32_t vertex_of(const PolygonNode& node, const std::array<std::ptrdiff_t, 8>& blocks) const {
        if (blocks[node.neighbour] < 0) return no_vertex;
        const auto block = static_cast<std::size_t>(blocks[node.neighbour]);
        const std::vector<std::uint16_t>& edges = parts_[block]->edges;
        const auto at = std::lower_bound(edges.begin(), edges.end(), node.edge);
        if (at == edges.end() || *at != node.edge) return no_vertex;
        return bases_[block] + static_cast<std::uint32_t>(at - edges.begin());
    }

    void cut_polygons(std::size_t task, TaskTriangles& out) {
        const std::size_t end = std::min((task + 1) * blocks_a_task, parts_.size());
        std::size_t nodes = 0;
        for (std::size_t i = task * blocks_a_task; i < end; ++i) nodes += parts_[i]->polygons.size();
        out.triangles.reserve(nodes / 2);  // quadrilaterals make up about the half
        out.middle_attributes.resize(attributes_.size());
        for (std::size_t i = task * blocks_a_task; i < end; ++i) cut_block(i, out);
        out.middle_normals.resize(out.middles.size());
        if (!out.middles.empty()) take_middle_normals(out);
    }

    void cut_block(std::size_t i, TaskTriangles& out) {
        const std::array<std::ptrdiff_t, 8> blocks = neighbours_of(i);
        const std::array<std::uint32_t, edges_a_block> own = own_vertices(i);
        std::array<std::uint8_t, 12> edges{};
        std::array<std::uint32_t, 12> vertices{};
        std::size_t count = 0;
        std::vector<std::array<std::uint8_t, 3>> cut;
        for (const PolygonNode& node : parts_[i]->polygons) {
            const std::uint32_t v = node.neighbour == 0 ? own[node.edge] : vertex_of(node, blocks);
            if (v == no_vertex) {
                contradiction_ = true;
                return;
            }
            vertices[count] = v;
            edges[count++] = node.cell_edge;
            if (!node.is_last) continue;
            cut.clear();
            const bool needs_middle = triangulate({edges.data(), count}, cut);
            const auto middle = nodes_ + static_cast<std::uint32_t>(out.middles.size());
            const auto global = [&](std::uint8_t k) { return k < count ? vertices[k] : middle; };
            for (const auto& t : cut) out.triangles.push_back({global(t[0]), global(t[1]), global(t[2])});
            if (needs_middle) {
                Vec3 sum;
                for (std::size_t k = 0; k < count; ++k) sum = sum + mesh_.vertices[vertices[k]];
                out.middles.push_back(sum / static_cast<double>(count));
                for (std::size_t k = 0; k < attributes_.size(); ++k)
                    out.middle_attributes[k].push_back(mean_attribute(k, {vertices.data(), count}));
            }
            count = 0;
        }
    }

    /// The mean of the defined values; NaN if there is none.
    double mean_attribute(std::size_t k, std::span<const std::uint32_t> vertices) const {
        double sum = 0;
        std::size_t defined = 0;
        for (const std::uint32_t v : vertices) {
            const double value = attributes_[k][v];
            if (value != value) continue;
            sum += value;
            ++defined;
        }
        return defined > 0 ? sum / static_cast<double>(defined) : std::numeric_limits<double>::quiet_NaN();
    }

    void take_middle_normals(TaskTriangles& out) {
        const std::size_t count = out.middles.size();
        std::vector<double> columns(7 * count);
        const auto column = [&](std::size_t k) { return std::span<double>(&columns[k * count], count); };
        for (std::size_t i = 0; i < count; ++i) {
            column(0)[i] = out.middles[i].x;
            column(1)[i] = out.middles[i].y;
            column(2)[i] = out.middles[i].z;
        }
        const FieldPool::Lease field = fields_.borrow();
        field->gradients({column(0), column(1), column(2)}, column(3), {column(4), column(5), column(6)});
        for (std::size_t i = 0; i < count; ++i) {
            const bool defined = column(3)[i] == column(3)[i];
            if (defined) out.middle_normals[i] = outward_normal({column(4)[i], column(5)[i], column(6)[i]});
        }
    }

    bool append_triangles(std::vector<TaskTriangles>& tasks) {
        std::size_t triangles = 0, middles = 0;
        for (const TaskTriangles& task : tasks) {
            triangles += task.triangles.size();
            middles += task.middles.size();
        }
        if (middles >= no_vertex - nodes_) return false;
        mesh_.triangles.reserve(triangles);
        mesh_.vertices.reserve(nodes_ + middles);
        mesh_.normals.reserve(nodes_ + middles);
        for (TaskTriangles& task : tasks) {
            const auto shift = static_cast<std::uint32_t>(mesh_.vertices.size()) - nodes_;
            for (Triangle& t : task.triangles) {
                for (std::uint32_t& v : t) v += v >= nodes_ ? shift : 0;
                mesh_.triangles.push_back(t);
            }
            mesh_.vertices.insert(mesh_.vertices.end(), task.middles.begin(), task.middles.end());
            mesh_.normals.insert(mesh_.normals.end(), task.middle_normals.begin(), task.middle_normals.end());
            for (std::size_t k = 0; k < attributes_.size(); ++k) {
                const std::vector<double>& column = task.middle_attributes[k];
                attributes_[k].insert(attributes_[k].end(), column.begin(), column.end());
            }
            task = {};
        }
        return true;
    }

    /// Normals that the gradient could not give: the mean of the triangles' normals; z where that vanishes.
    void fill_missing_normals() {
        const auto is_missing = [](Vec3 n) { return n == Vec3{0, 0, 0}; };
        if (std::none_of(mesh_.normals.begin(), mesh_.normals.end(), is_missing)) return;
        const std::vector<Vec3> means = mean_normals(mesh_);
        for (std::size_t v = 0; v < means.size(); ++v) {
            if (!is_missing(mesh_.normals[v])) continue;
            mesh_.normals[v] = is_missing(means[v]) ? Vec3{0, 0, 1} : means[v];
        }
    }

    FieldPool& fields_;
    const Job& job_;
    std::vector<std::uint64_t> codes_;
    std::vector<std::unique_ptr<BlockMesh>> parts_;
    std::vector<std::uint32_t> bases_;
    std::uint32_t nodes_ = 0;
    Mesh mesh_;
    std::vector<std::vector<double>> attributes_;
    std::atomic<bool> contradiction_{false};
};

}  // namespace

Result<AssembledMesh> assemble(const std::vector<std::uint64_t>& codes,
                               std::vector<std::unique_ptr<BlockMesh>> parts, std::size_t attributes,
                               FieldPool& fields, const Job& job) {
    return Assembly(codes, std::move(parts), attributes, fields, job).run();
}

}  // namespace frep::contouring
