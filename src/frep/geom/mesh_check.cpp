// check(): edges and fans are found vertex by vertex from one list of the triangles at each vertex, so that
// memory stays small (no table of edges); measures are summed in blocks and the blocks in a fixed tree.
// Volume, centroid and inertia: signed tetrahedra from a reference point (divergence theorem; Mirtich 1996,
// Eberly 2002). With the corners a, b, c of a triangle, s = a + b + c and D = det(a, b, c), its tetrahedron
// adds D/6 to the volume, D/24 s to the first moments and D/120 (s_i s_j + a_i a_j + b_i b_j + c_i c_j) to
// the second moments.
#include "frep/geom/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <utility>
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

/// A sum with its rounding errors carried along (Neumaier 1974).
class CompensatedSum {
  public:
    void add(double term) {
        const double sum = sum_ + term;
        const bool term_smaller = (sum_ < 0 ? -sum_ : sum_) >= (term < 0 ? -term : term);
        lost_ += term_smaller ? (sum_ - sum) + term : (term - sum) + sum_;
        sum_ = sum;
    }
    double value() const { return sum_ + lost_; }

  private:
    double sum_ = 0, lost_ = 0;
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
        const std::size_t at = tri[0] == v ? 0 : tri[1] == v ? 1 : 2;
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

/// What a triangle adds to its component: each edge is counted with one of its triangles.
struct Share {
    std::uint8_t edges = 0, boundary_edges = 0;
};

/// Counts the edges whose smaller end is v, joins their triangles, and tells whether an edge at v (of either
/// direction) has three or more triangles.
bool scan_edges(const std::vector<EdgeUse>& uses, Index v, MeshReport& report, std::vector<Share>& shares,
                DisjointSets& components) {
    bool crowded = false;
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i, leaving = 0;
        for (; end < uses.size() && uses[end].other == uses[i].other; ++end) {
            leaving += uses[end].leaving ? 1 : 0;
            components.join(uses[i].triangle, uses[end].triangle);
        }
        const std::size_t total = end - i;
        crowded = crowded || total > 2;
        if (v < uses[i].other) {
            Share& share = shares[uses[i].triangle];
            ++share.edges;
            if (total == 1) ++share.boundary_edges;
            if (total > 2) ++report.nonmanifold_edges;
            if (total > 1 && 2 * leaving != total) ++report.misoriented_edges;
        }
        i = end;
    }
    return crowded;
}

/// A component as it is counted and measured.
struct Component {
    std::size_t triangles = 0, vertices = 0, edges = 0, boundary_edges = 0;
    Vec3 low, high;
    CompensatedSum area, volume;
};

/// The components in the order of their first triangles, and the number of each triangle's component.
struct Components {
    std::vector<Component> list;
    std::vector<Index> of_triangle;
};

Components numbered(DisjointSets& sets, const std::vector<Share>& shares) {
    Components components;
    components.of_triangle.resize(shares.size());
    for (std::size_t t = 0; t < shares.size(); ++t) {
        const Index root = sets.root(static_cast<Index>(t));  // the first triangle of its component
        if (root == t) {
            components.of_triangle[t] = static_cast<Index>(components.list.size());
            components.list.emplace_back();
        }
        const Index number = components.of_triangle[t] = components.of_triangle[root];
        Component& component = components.list[number];
        ++component.triangles;
        component.edges += shares[t].edges;
        component.boundary_edges += shares[t].boundary_edges;
    }
    return components;
}

/// Counts the vertices of each component: one where two touch counts for both. Returns those in use.
std::size_t count_vertices(const Mesh& mesh, const Stars& stars, Components& components) {
    std::size_t used = 0;
    std::vector<Index> numbers;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        numbers.clear();
        for (std::uint64_t k = stars.start[v]; k < stars.start[v + 1]; ++k)
            numbers.push_back(components.of_triangle[stars.list[k]]);
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        for (const Index number : numbers) ++components.list[number].vertices;
        used += numbers.empty() ? 0 : 1;
    }
    return used;
}

std::int64_t euler_characteristic(std::size_t vertices, std::size_t edges, std::size_t triangles) {
    return static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(edges) +
           static_cast<std::int64_t>(triangles);
}

Components check_topology(const Mesh& mesh, MeshReport& report) {
    const Stars stars = stars_of(mesh);
    DisjointSets sets(mesh.triangles.size());
    std::vector<Share> shares(mesh.triangles.size());
    std::vector<EdgeUse> uses;
    std::vector<Index> order;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (stars.start[i] == stars.start[i + 1]) continue;
        const Index v = static_cast<Index>(i);
        collect_uses(mesh, stars, v, uses);
        const bool crowded = scan_edges(uses, v, report, shares, sets);
        if (crowded || !is_one_fan(uses, order)) ++report.nonmanifold_vertices;
    }
    Components components = numbered(sets, shares);
    const std::size_t used_vertices = count_vertices(mesh, stars, components);
    std::size_t edges = 0;
    double genus = 0;
    for (const Component& c : components.list) {
        edges += c.edges;
        report.boundary_edges += c.boundary_edges;
        genus += 1 - 0.5 * static_cast<double>(euler_characteristic(c.vertices, c.edges, c.triangles));
    }
    report.components = components.list.size();
    report.euler_characteristic = euler_characteristic(used_vertices, edges, mesh.triangles.size());
    report.closed = !mesh.triangles.empty() && report.boundary_edges == 0;
    report.manifold = report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0;
    report.oriented = report.misoriented_edges == 0;
    if (report.closed) report.genus = genus;
    return components;
}

/// Area of some triangles, and volume and moments from a reference point.
struct Sums {
    double area = 0;
    double volume = 0;
    Vec3 moment{0, 0, 0};    ///< integrals of x, y, z
    Vec3 squares{0, 0, 0};   ///< integrals of xx, yy, zz
    Vec3 products{0, 0, 0};  ///< integrals of yz, zx, xy
};

Sums operator+(const Sums& a, const Sums& b) {
    return {a.area + b.area, a.volume + b.volume, a.moment + b.moment, a.squares + b.squares,
            a.products + b.products};
}

/// The products by coordinate.
constexpr Vec3 each(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
/// (y, z, x)
constexpr Vec3 turned(const Vec3& a) { return {a.y, a.z, a.x}; }
/// (yz, zx, xy)
constexpr Vec3 mixed(const Vec3& a) { return each(turned(a), turned(turned(a))); }

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
        const Vec3 s = a + b + c;
        sums.moment = sums.moment + s * (six_volumes / 24);
        sums.squares =
            sums.squares + (each(s, s) + each(a, a) + each(b, b) + each(c, c)) * (six_volumes / 120);
        sums.products = sums.products + (mixed(s) + mixed(a) + mixed(b) + mixed(c)) * (six_volumes / 120);
    }
    return sums;
}

Vec3 lower(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

void measure(const Mesh& mesh, MeshReport& report) {
    if (mesh.triangles.empty()) return;
    Vec3 lo = mesh.vertices[mesh.triangles[0][0]];
    Vec3 hi = lo;
    for (const Triangle& tri : mesh.triangles) {
        for (const Index v : tri) {
            const Vec3& p = mesh.vertices[v];
            lo = lower(lo, p);
            hi = upper(hi, p);
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
    if (total.volume == 0) return;
    const Vec3 center = total.moment * (1 / total.volume);
    report.centroid = reference + center;
    const Vec3 squares = total.squares - each(center, center) * total.volume;
    const Vec3 products = total.products - mixed(center) * total.volume;
    report.inertia = Inertia{squares.y + squares.z, squares.z + squares.x, squares.x + squares.y,
                             -products.z,           -products.y,           -products.x};
}

/// Bounds, area and volume of each component; volumes from the middle of its box.
void measure_components(const Mesh& mesh, Components& components) {
    for (Component& c : components.list) c.triangles = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Component& c = components.list[components.of_triangle[t]];
        for (const Index v : mesh.triangles[t]) {
            const Vec3& p = mesh.vertices[v];
            const bool first = c.triangles == 0 && v == mesh.triangles[t][0];
            c.low = first ? p : lower(c.low, p);
            c.high = first ? p : upper(c.high, p);
        }
        ++c.triangles;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Component& c = components.list[components.of_triangle[t]];
        const Vec3 reference = (c.low + c.high) * 0.5;
        const Sums sums = sum_block(mesh, t, t + 1, reference);
        c.area.add(sums.area);
        c.volume.add(sums.volume);
    }
}

std::vector<ComponentReport> reports_of(const Components& components) {
    std::vector<ComponentReport> reports;
    reports.reserve(components.list.size());
    for (const Component& c : components.list) {
        ComponentReport report;
        report.triangles = c.triangles;
        report.closed = c.boundary_edges == 0;
        report.area = c.area.value();
        report.bounds = {c.low, c.high};
        report.euler_characteristic = euler_characteristic(c.vertices, c.edges, c.triangles);
        if (report.closed) {
            report.volume = c.volume.value();
            report.genus = 1 - 0.5 * static_cast<double>(report.euler_characteristic);
        }
        reports.push_back(report);
    }
    const auto key = [](const ComponentReport& r) { return r.area >= 0 ? r.area : -1; };  // NaN last
    std::stable_sort(reports.begin(), reports.end(),
                     [key](const ComponentReport& a, const ComponentReport& b) { return key(a) > key(b); });
    return reports;
}

}  // namespace

MeshReport check(const Mesh& mesh, const CheckOptions& options, const Job& job) {
    MeshReport report;
    report.vertices = mesh.vertices.size();
    report.triangles = mesh.triangles.size();
    FREP_CHECK(is_valid(mesh));
    const Mesh merged = merge_equal_positions(mesh, {.as_float32 = options.as_float32});
    Components components = check_topology(merged, report);
    measure(merged, report);
    measure_components(merged, components);
    report.component_list = reports_of(components);
    if (options.self_intersections) {
        auto found = find_self_intersections(mesh, {.as_float32 = options.as_float32}, job);
        if (found) report.self_intersections = std::move(*found);
    }
    return report;
}

}  // namespace frep
