// check(): edges and fans are found vertex by vertex from one list of the triangles at each vertex, so that
// memory stays small (no table of edges); measures are summed in blocks and the blocks in a fixed tree.
// Volume and centroid: signed tetrahedra from a reference point (divergence theorem).
#include "frep/geom/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "frep/base/result.h"

namespace frep {

namespace {

using Index = std::uint32_t;

/// The triangles at each vertex: those of vertex v are list[start[v]] .. list[start[v + 1] - 1].
struct Stars {
    std::vector<std::uint64_t> start;
    std::vector<Index> list;
};

Stars stars_of(const Mesh& mesh) {
    Stars stars;
    stars.start.assign(mesh.vertices.size() + 1, 0);
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) ++stars.start[v + 1];
    }
    std::partial_sum(stars.start.begin(), stars.start.end(), stars.start.begin());
    stars.list.resize(3 * mesh.triangles.size());
    std::vector<std::uint64_t> next(stars.start.begin(), stars.start.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const Index v : mesh.triangles[t]) stars.list[next[v]++] = static_cast<Index>(t);
    }
    return stars;
}

/// Disjoint sets of 0 .. n-1; the smallest member is the root.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
    Index root(Index i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void join(Index a, Index b) {
        a = root(a);
        b = root(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<Index> parent_;
};

/// One triangle's use of an edge (v, other) seen from v.
struct EdgeUse {
    Index other;
    Index triangle;
    bool leaving;  ///< the triangle runs from v to other
    bool operator<(const EdgeUse& b) const {
        return other != b.other ? other < b.other : triangle < b.triangle;
    }
};

/// The uses of the edges at vertex v, sorted by the other end.
void collect_uses(const Mesh& mesh, const Stars& stars, Index v, std::vector<EdgeUse>& uses) {
    uses.clear();
    for (std::uint64_t k = stars.start[v]; k < stars.start[v + 1]; ++k) {
        const Index t = stars.list[k];
        const Triangle& tri = mesh.triangles[t];
        const int at = tri[0] == v ? 0 : tri[1] == v ? 1 : 2;
        uses.push_back({tri[(at + 1) % 3], t, true});
        uses.push_back({tri[(at + 2) % 3], t, false});
    }
    std::sort(uses.begin(), uses.end());
}

/// True when the triangles at a vertex hang together through its edges. `fans` and `order` are scratch.
bool is_one_fan(const std::vector<EdgeUse>& uses, std::vector<Index>& order) {
    order.clear();
    for (const EdgeUse& use : uses) order.push_back(use.triangle);
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    DisjointSets fans(order.size());
    std::size_t count = order.size();
    const auto local = [&](Index t) {
        return static_cast<Index>(std::lower_bound(order.begin(), order.end(), t) - order.begin());
    };
    for (std::size_t i = 1; i < uses.size(); ++i) {
        if (uses[i].other != uses[i - 1].other) continue;
        const Index a = fans.root(local(uses[i].triangle));
        const Index b = fans.root(local(uses[i - 1].triangle));
        if (a != b) --count;
        fans.join(a, b);
    }
    return count <= 1;
}

struct Counts {
    std::size_t used_vertices = 0;
    std::size_t edges = 0;
};

/// Counts the edges whose smaller end is v, joins their triangles, and tells whether an edge at v (of either
/// direction) has three or more triangles.
bool scan_edges(const std::vector<EdgeUse>& uses, Index v, MeshReport& report, Counts& counts,
                DisjointSets& components) {
    bool crowded = false;
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i, leaving = 0;
        while (end < uses.size() && uses[end].other == uses[i].other) leaving += uses[end++].leaving ? 1 : 0;
        const std::size_t total = end - i;
        crowded = crowded || total > 2;
        if (v < uses[i].other) {
            ++counts.edges;
            if (total == 1) ++report.boundary_edges;
            if (total > 2) ++report.nonmanifold_edges;
            if (total > 1 && 2 * leaving != total) ++report.misoriented_edges;
            for (std::size_t k = i + 1; k < end; ++k) components.join(uses[i].triangle, uses[k].triangle);
        }
        i = end;
    }
    return crowded;
}

/// The number of pairs (component, vertex of it): a vertex where two components touch counts for both.
std::size_t component_vertices(const Mesh& mesh, const Stars& stars, DisjointSets& components) {
    std::size_t pairs = 0;
    std::vector<Index> roots;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        roots.clear();
        for (std::uint64_t k = stars.start[v]; k < stars.start[v + 1]; ++k) {
            roots.push_back(components.root(stars.list[k]));
        }
        std::sort(roots.begin(), roots.end());
        pairs += static_cast<std::size_t>(std::unique(roots.begin(), roots.end()) - roots.begin());
    }
    return pairs;
}

void check_topology(const Mesh& mesh, MeshReport& report) {
    const Stars stars = stars_of(mesh);
    DisjointSets components(mesh.triangles.size());
    Counts counts;
    std::vector<EdgeUse> uses;
    std::vector<Index> order;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (stars.start[i] == stars.start[i + 1]) continue;
        const Index v = static_cast<Index>(i);
        ++counts.used_vertices;
        collect_uses(mesh, stars, v, uses);
        const bool crowded = scan_edges(uses, v, report, counts, components);
        if (crowded || !is_one_fan(uses, order)) ++report.nonmanifold_vertices;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (components.root(static_cast<Index>(t)) == t) ++report.components;
    }
    const auto faces = static_cast<std::int64_t>(mesh.triangles.size());
    const auto edges = static_cast<std::int64_t>(counts.edges);
    report.euler_characteristic = static_cast<std::int64_t>(counts.used_vertices) - edges + faces;
    report.closed = faces > 0 && report.boundary_edges == 0;
    report.manifold = report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0;
    report.oriented = report.misoriented_edges == 0;
    if (report.closed) {
        const auto apart = static_cast<std::int64_t>(component_vertices(mesh, stars, components));
        report.genus =
            static_cast<double>(report.components) - 0.5 * static_cast<double>(apart - edges + faces);
    }
}

/// Area, volume and volume moment of some triangles, the latter two from a reference point.
struct Sums {
    double area = 0;
    double volume = 0;
    Vec3 moment{0, 0, 0};
};

Sums operator+(const Sums& a, const Sums& b) {
    return {a.area + b.area, a.volume + b.volume, a.moment + b.moment};
}

constexpr std::size_t block_size = 1024;

Sums sum_block(const Mesh& mesh, std::size_t begin, std::size_t end, const Vec3& reference) {
    Sums sums;
    for (std::size_t t = begin; t < end; ++t) {
        const Triangle& tri = mesh.triangles[t];
        const Vec3 a = mesh.vertices[tri[0]] - reference;
        const Vec3 b = mesh.vertices[tri[1]] - reference;
        const Vec3 c = mesh.vertices[tri[2]] - reference;
        const Vec3 normal = cross(b - a, c - a);
        const double six_volumes = dot(a, cross(b, c));
        sums.area += 0.5 * length(normal);
        sums.volume += six_volumes / 6;
        sums.moment = sums.moment + (a + b + c) * (six_volumes / 24);
    }
    return sums;
}

void measure(const Mesh& mesh, MeshReport& report) {
    if (mesh.triangles.empty()) return;
    Vec3 lo = mesh.vertices[mesh.triangles[0][0]];
    Vec3 hi = lo;
    for (const Triangle& tri : mesh.triangles) {
        for (const Index v : tri) {
            const Vec3& p = mesh.vertices[v];
            lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
            hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
        }
    }
    report.bounds = Box3{lo, hi};
    const Vec3 reference = (lo + hi) * 0.5;
    std::vector<Sums> blocks;
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += block_size) {
        blocks.push_back(
            sum_block(mesh, begin, std::min(begin + block_size, mesh.triangles.size()), reference));
    }
    for (std::size_t stride = 1; stride < blocks.size(); stride *= 2) {
        for (std::size_t i = 0; i + stride < blocks.size(); i += 2 * stride) {
            blocks[i] = blocks[i] + blocks[i + stride];
        }
    }
    const Sums& total = blocks.front();
    report.area = total.area;
    if (!report.closed) return;
    report.volume = total.volume;
    if (total.volume != 0) report.centroid = reference + total.moment * (1 / total.volume);
}

}  // namespace

MeshReport check(const Mesh& mesh, const CheckOptions& options, const Job& job) {
    MeshReport report;
    report.vertices = mesh.vertices.size();
    report.triangles = mesh.triangles.size();
    FREP_CHECK(is_valid(mesh));
    const Mesh merged = merge_equal_positions(mesh, {.as_float32 = options.as_float32});
    check_topology(merged, report);
    measure(merged, report);
    static_cast<void>(job);
    return report;
}

}  // namespace frep
