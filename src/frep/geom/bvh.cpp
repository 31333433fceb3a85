// Implementation of bvh.h. The shape of the tree follows from the number of triangles alone: leaf k holds the
// places 4k .. 4k+3 of the order, and a subtree of m leaves has 2m - 1 nodes in preorder. So subtrees are
// built in parallel into places known beforehand, and traversals need a stack of at most 64 entries.
#include "frep/geom/bvh.h"

#include <algorithm>

#include "frep/base/parallel.h"
#include "frep/base/result.h"

namespace frep {

namespace {

using Index = std::uint32_t;
constexpr std::size_t stack_size = 64;

std::size_t leaf_count(std::size_t triangles) {
    return (triangles + TriangleBvh::leaf_size - 1) / TriangleBvh::leaf_size;
}

Vec3 lower(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
Box3 hull(const Box3& a, const Box3& b) { return {lower(a.min, b.min), upper(a.max, b.max)}; }

bool is_finite(const Vec3& p) {
    const double sum = p.x * 0 + p.y * 0 + p.z * 0;  // NaN when one is not finite
    return sum == 0;
}

double coordinate(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// A triangle to be placed: twice the center of its box.
struct Item {
    Vec3 center;
    Index triangle;
};

int longest_axis(const std::vector<Item>& items, std::size_t begin, std::size_t end) {
    Vec3 lo = items[begin].center, hi = lo;
    for (std::size_t i = begin + 1; i < end; ++i) {
        lo = lower(lo, items[i].center);
        hi = upper(hi, items[i].center);
    }
    const Vec3 side = hi - lo;
    if (side.x >= side.y && side.x >= side.z) return 0;
    return side.y >= side.z ? 1 : 2;
}

/// A subtree to be built.
struct Part {
    std::size_t node, begin, end;
};

/// Fills the nodes of the tree (without the boxes of inner nodes) and orders the items.
class Builder {
  public:
    Builder(const TriangleBvh& tree, std::vector<Item>& items, std::vector<TriangleBvh::Node>& nodes)
        : tree_(tree), items_(items), nodes_(nodes) {}

    void build(const Job& job) {
        std::vector<Part> parts{{0, 0, items_.size()}};
        while (parts.size() < 256 && parts.front().end - parts.front().begin > 2048) {
            std::vector<Part> halves(2 * parts.size());
            parallel_for(job, parts.size(), [&](std::size_t i) {
                halves[2 * i] = parts[i];
                halves[2 * i + 1] = split(halves[2 * i]);
            });
            if (job.cancelled()) return;
            parts = std::move(halves);
        }
        parallel_for(job, parts.size(), [&](std::size_t i) { build_part(parts[i]); });
    }

  private:
    /// Makes `part` an inner node, moves on to its left child and returns the right one.
    Part split(Part& part) {
        const std::size_t left_leaves = (leaf_count(part.end - part.begin) + 1) / 2;
        const std::size_t middle = part.begin + left_leaves * TriangleBvh::leaf_size;
        const int axis = longest_axis(items_, part.begin, part.end);
        const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(part.begin), at(middle), at(part.end), [axis](const Item& a, const Item& b) {
            const double ca = coordinate(a.center, axis), cb = coordinate(b.center, axis);
            return ca != cb ? ca < cb : a.triangle < b.triangle;
        });
        nodes_[part.node].begin = static_cast<Index>(part.begin);
        nodes_[part.node].end = static_cast<Index>(part.end);
        const Part right{part.node + 2 * left_leaves, middle, part.end};
        part = {part.node + 1, part.begin, middle};
        return right;
    }

    void finish_leaf(const Part& part) {
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(part.begin);
        const auto last = items_.begin() + static_cast<std::ptrdiff_t>(part.end);
        std::sort(first, last, [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
        Box3 box = tree_.box(first->triangle);
        for (auto item = first + 1; item != last; ++item) box = hull(box, tree_.box(item->triangle));
        nodes_[part.node] = {box, static_cast<Index>(part.begin), static_cast<Index>(part.end)};
    }

    void build_part(Part part) {
        std::array<Part, stack_size> stack;
        std::size_t depth = 0;
        for (;;) {
            while (part.end - part.begin > TriangleBvh::leaf_size) stack[depth++] = split(part);
            finish_leaf(part);
            if (depth == 0) return;
            part = stack[--depth];
        }
    }

    const TriangleBvh& tree_;
    std::vector<Item>& items_;
    std::vector<TriangleBvh::Node>& nodes_;
};

double squared_distance(const Vec3& p, const Box3& box) {
    const Vec3 d{std::max({box.min.x - p.x, p.x - box.max.x, 0.0}),
                 std::max({box.min.y - p.y, p.y - box.max.y, 0.0}),
                 std::max({box.min.z - p.z, p.z - box.max.z, 0.0})};
    return dot(d, d);
}

/// A ray prepared for boxes and triangles (Woop, Benthin, Wald 2013): the axes are renamed so that `kz` is
/// the one along which the ray is longest, and points are sheared so that the ray runs along it.
class PreparedRay {
  public:
    explicit PreparedRay(const TriangleBvh::Ray& ray) : ray_(ray) {
        const Vec3& d = ray.direction;
        const double x = d.x < 0 ? -d.x : d.x, y = d.y < 0 ? -d.y : d.y, z = d.z < 0 ? -d.z : d.z;
        kz_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        kx_ = (kz_ + 1) % 3;
        ky_ = (kz_ + 2) % 3;
        shear_x_ = coordinate(d, kx_) / coordinate(d, kz_);
        shear_y_ = coordinate(d, ky_) / coordinate(d, kz_);
        scale_ = 1 / coordinate(d, kz_);
    }

    /// Where the ray enters the box, or nothing when it does so after `t_max` or never. Boxes are taken
    /// slightly too large, so that no hit of a triangle in it is lost by rounding.
    std::optional<double> enters(const Box3& box, double t_max) const {
        double near = ray_.t_min, far = t_max;
        for (int axis = 0; axis < 3; ++axis) {
            const double o = coordinate(ray_.origin, axis), d = coordinate(ray_.direction, axis);
            const double lo = coordinate(box.min, axis), hi = coordinate(box.max, axis);
            const double margin = 0x1p-48 * std::max({lo < 0 ? -lo : lo, hi < 0 ? -hi : hi, o < 0 ? -o : o});
            const double a = lo - margin - o, b = hi + margin - o;
            if (d == 0) {
                if (a > 0 || b < 0) return std::nullopt;
                continue;
            }
            const double ta = a / d, tb = b / d;
            near = std::max(near, std::min(ta, tb));
            far = std::min(far, std::max(ta, tb));
        }
        if (near > far + (far < 0 ? -far : far) * 0x1p-50) return std::nullopt;
        return near;
    }

    /// The parameter at which the ray's line meets the triangle.
    std::optional<double> hits(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const Vec3 p = sheared(a), q = sheared(b), r = sheared(c);
        const double u = r.x * q.y - r.y * q.x, v = p.x * r.y - p.y * r.x, w = q.x * p.y - q.y * p.x;
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
        const double sum = u + v + w;
        if (sum == 0) return std::nullopt;
        return (u * p.z + v * q.z + w * r.z) / sum;
    }

  private:
    Vec3 sheared(const Vec3& point) const {
        const Vec3 p = point - ray_.origin;
        const double z = coordinate(p, kz_);
        return {coordinate(p, kx_) - shear_x_ * z, coordinate(p, ky_) - shear_y_ * z, scale_ * z};
    }

    const TriangleBvh::Ray& ray_;
    int kx_ = 0, ky_ = 1, kz_ = 2;
    double shear_x_ = 0, shear_y_ = 0, scale_ = 1;
};

/// The point of the segment a b nearest to p.
Vec3 nearest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = dot(p - a, along), whole = dot(along, along);
    if (!(t > 0)) return a;
    return t >= whole ? b : a + along * (t / whole);
}

}  // namespace

TriangleBvh::TriangleBvh(const Mesh& mesh, const Job& job) : mesh_(&mesh) {
    FREP_CHECK(is_valid(mesh) && mesh.triangles.size() <= 0xfffffff0u);
    std::vector<Item> items;
    items.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (!is_finite(mesh.vertices[t[0]]) || !is_finite(mesh.vertices[t[1]]) ||
            !is_finite(mesh.vertices[t[2]]))
            continue;
        const Box3 b = box(static_cast<Index>(i));
        items.push_back({b.min + b.max, static_cast<Index>(i)});
    }
    if (items.empty()) return;
    nodes_.resize(2 * leaf_count(items.size()) - 1);
    Builder(*this, items, nodes_).build(job);
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        if (is_leaf(nodes_[i])) continue;
        nodes_[i].box = hull(nodes_[left_child(i)].box, nodes_[right_child(i)].box);
    }
    order_.reserve(items.size());
    for (const Item& item : items) order_.push_back(item.triangle);
}

std::size_t TriangleBvh::right_child(std::size_t node) const {
    const std::size_t leaves = leaf_count(nodes_[node].end - nodes_[node].begin);
    return node + 2 * ((leaves + 1) / 2);
}

Box3 TriangleBvh::box(std::uint32_t triangle) const {
    const Triangle& t = mesh_->triangles[triangle];
    const Vec3 &a = mesh_->vertices[t[0]], &b = mesh_->vertices[t[1]], &c = mesh_->vertices[t[2]];
    return {lower(lower(a, b), c), upper(upper(a, b), c)};
}

std::optional<TriangleBvh::Nearest> TriangleBvh::nearest(const Vec3& p, double within) const {
    struct Entry {
        std::size_t node;
        double squared;
    };
    std::optional<Nearest> best;
    double limit = within * within;
    std::array<Entry, stack_size> stack;
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = {0, squared_distance(p, nodes_[0].box)};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (!(entry.squared <= limit)) continue;
        const Node& node = nodes_[entry.node];
        if (!is_leaf(node)) {
            Entry near{left_child(entry.node), 0}, far{right_child(entry.node), 0};
            near.squared = squared_distance(p, nodes_[near.node].box);
            far.squared = squared_distance(p, nodes_[far.node].box);
            if (far.squared < near.squared) std::swap(near, far);
            stack[depth++] = far;
            stack[depth++] = near;
            continue;
        }
        for (Index k = node.begin; k < node.end; ++k) {
            const Triangle& t = mesh_->triangles[order_[k]];
            const Vec3 q = nearest_point_of_triangle(p, mesh_->vertices[t[0]], mesh_->vertices[t[1]],
                                                     mesh_->vertices[t[2]]);
            const double squared = dot(q - p, q - p);
            if (!(squared <= limit) || (best && squared == limit && order_[k] > best->triangle)) continue;
            limit = squared;
            best = Nearest{q, 0, order_[k]};
        }
    }
    if (best) best->distance = length(best->point - p);
    return best;
}

std::optional<TriangleBvh::Hit> TriangleBvh::first_hit(const Ray& ray, const Accept& accept) const {
    const PreparedRay prepared(ray);
    std::optional<Hit> best;
    double limit = ray.t_max;
    std::array<std::size_t, stack_size> stack;
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
        const std::size_t at = stack[--depth];
        const Node& node = nodes_[at];
        if (!prepared.enters(node.box, limit)) continue;
        if (!is_leaf(node)) {
            std::size_t near = left_child(at), far = right_child(at);
            const auto t_near = prepared.enters(nodes_[near].box, limit);
            const auto t_far = prepared.enters(nodes_[far].box, limit);
            if (t_far && (!t_near || *t_far < *t_near)) std::swap(near, far);
            if (t_near && t_far) stack[depth++] = far;
            if (t_near || t_far) stack[depth++] = near;
            continue;
        }
        for (Index k = node.begin; k < node.end; ++k) {
            const Triangle& t = mesh_->triangles[order_[k]];
            const auto hit =
                prepared.hits(mesh_->vertices[t[0]], mesh_->vertices[t[1]], mesh_->vertices[t[2]]);
            if (!hit || !(*hit >= ray.t_min) || !(*hit <= limit)) continue;
            if (best && *hit == limit && order_[k] > best->triangle) continue;
            if (accept && !accept(order_[k])) continue;
            limit = *hit;
            best = Hit{*hit, order_[k]};
        }
    }
    return best;
}

Vec3 nearest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = cross(b - a, c - a);
    const double nn = dot(n, n);
    if (nn > 0 && dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
        dot(cross(a - c, p - c), n) >= 0) {
        return p - n * (dot(p - a, n) / nn);
    }
    Vec3 best = nearest_point_of_segment(p, a, b);
    for (const Vec3& q : {nearest_point_of_segment(p, b, c), nearest_point_of_segment(p, c, a)}) {
        if (dot(q - p, q - p) < dot(best - p, best - p)) best = q;
    }
    return best;
}

}  // namespace frep
