// Implementation of self_intersection.h. Every leaf of the tree is compared with itself and with the leaves
// behind it whose boxes meet its own; the leaves are dealt out in chunks, each with a slot for its findings.
#include "frep/geom/self_intersection.h"

#include <algorithm>
#include <array>

#include "frep/base/parallel.h"
#include "frep/geom/bvh.h"
#include "frep/geom/triangle_overlap.h"

namespace frep {

namespace {

using Index = std::uint32_t;

bool overlap(const Box3& a, const Box3& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

/// The common point of two triangles of the mesh outside of what they share, the shared corners put first.
std::optional<Vec3> common_point_of(const Mesh& mesh, Index first, Index second) {
    Triangle a = mesh.triangles[first], b = mesh.triangles[second];
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto twin = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
        if (twin == b.end()) continue;
        std::swap(a[shared], a[i]);
        std::iter_swap(b.begin() + static_cast<std::ptrdiff_t>(shared), twin);
        ++shared;
    }
    const auto corners = [&mesh](const Triangle& t) {
        return Corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    };
    return common_point(corners(a), corners(b), static_cast<int>(shared));
}

bool listed_before(const IntersectingPair& a, const IntersectingPair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// Keeps the first `limit` pairs.
void shorten(std::vector<IntersectingPair>& pairs, std::size_t limit) {
    std::sort(pairs.begin(), pairs.end(), listed_before);
    if (pairs.size() > limit) pairs.resize(limit);
}

/// Compares triangles in pairs, leaf by leaf.
class Search {
  public:
    Search(const TriangleBvh& tree, std::size_t max_listed) : tree_(tree), max_listed_(max_listed) {}

    /// Adds the pairs of the leaf with itself and with the leaves behind it.
    void compare_leaf(std::size_t leaf, SelfIntersections& found) const {
        const auto& nodes = tree_.nodes();
        const TriangleBvh::Node& here = nodes[leaf];
        std::array<Box3, TriangleBvh::leaf_size> boxes;
        for (Index k = here.begin; k < here.end; ++k) boxes[k - here.begin] = tree_.box(tree_.order()[k]);
        std::array<std::size_t, 64> stack{0};
        std::size_t depth = 1;
        while (depth > 0) {
            const std::size_t at = stack[--depth];
            const TriangleBvh::Node& node = nodes[at];
            if (node.end <= here.begin || !overlap(node.box, here.box)) continue;
            if (TriangleBvh::is_leaf(node)) {
                compare_leaves(here, boxes, node, found);
            } else {
                stack[depth++] = tree_.right_child(at);
                stack[depth++] = TriangleBvh::left_child(at);
            }
        }
    }

  private:
    void compare_leaves(const TriangleBvh::Node& here, const std::array<Box3, TriangleBvh::leaf_size>& boxes,
                        const TriangleBvh::Node& there, SelfIntersections& found) const {
        for (Index j = there.begin; j < there.end; ++j) {
            const Index second = tree_.order()[j];
            const Box3 box = tree_.box(second);
            if (!overlap(here.box, box)) continue;
            for (Index i = here.begin; i < std::min(here.end, j); ++i) {
                if (overlap(boxes[i - here.begin], box)) compare(tree_.order()[i], second, found);
            }
        }
    }

    void compare(Index a, Index b, SelfIntersections& found) const {
        const Index first = std::min(a, b), second = std::max(a, b);
        const std::optional<Vec3> place = common_point_of(tree_.mesh(), first, second);
        if (!place) return;
        ++found.count;
        found.listed.push_back({first, second, *place});
        if (found.listed.size() >= 2 * max_listed_ + 64) shorten(found.listed, max_listed_);
    }

    const TriangleBvh& tree_;
    std::size_t max_listed_;
};

/// Replaces the indices into the merged mesh by those into the mesh before merging.
void restore_indices(const Mesh& mesh, bool as_float32, std::vector<IntersectingPair>& pairs) {
    if (pairs.empty()) return;
    std::vector<Index*> wanted;
    for (IntersectingPair& pair : pairs) {
        wanted.push_back(&pair.first);
        wanted.push_back(&pair.second);
    }
    std::sort(wanted.begin(), wanted.end(), [](const Index* a, const Index* b) { return *a < *b; });
    Index kept = 0;
    auto next = wanted.begin();
    for (std::size_t t = 0; t < mesh.triangles.size() && next != wanted.end(); ++t) {
        if (collapses(mesh, mesh.triangles[t], {.as_float32 = as_float32})) continue;
        for (; next != wanted.end() && **next == kept; ++next) **next = static_cast<Index>(t);
        ++kept;
    }
}

}  // namespace

Result<SelfIntersections> find_self_intersections(const Mesh& mesh, const SelfIntersectionOptions& options,
                                                  const Job& job) {
    constexpr std::size_t chunk_size = 256;
    const Error cancelled{ErrorKind::cancelled, "the search for self-intersections was cancelled"};
    FREP_CHECK(is_valid(mesh));
    Mesh bare;
    bare.vertices = mesh.vertices;
    bare.triangles = mesh.triangles;
    const Mesh merged = merge_equal_positions(bare, {.as_float32 = options.as_float32});
    const TriangleBvh tree(merged, job);
    if (job.cancelled()) return cancelled;

    std::vector<Index> leaves;
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        if (TriangleBvh::is_leaf(tree.nodes()[i])) leaves.push_back(static_cast<Index>(i));
    }
    const Search search(tree, options.max_listed);
    std::vector<SelfIntersections> chunks((leaves.size() + chunk_size - 1) / chunk_size);
    parallel_for(job, chunks.size(), [&](std::size_t c) {
        const std::size_t end = std::min(leaves.size(), (c + 1) * chunk_size);
        for (std::size_t i = c * chunk_size; i < end && !job.cancelled(); ++i)
            search.compare_leaf(leaves[i], chunks[c]);
        shorten(chunks[c].listed, options.max_listed);
    });
    if (job.cancelled()) return cancelled;

    SelfIntersections all;
    for (const SelfIntersections& chunk : chunks) {
        all.count += chunk.count;
        all.listed.insert(all.listed.end(), chunk.listed.begin(), chunk.listed.end());
    }
    shorten(all.listed, options.max_listed);
    restore_indices(mesh, options.as_float32, all.listed);
    return all;
}

}  // namespace frep
