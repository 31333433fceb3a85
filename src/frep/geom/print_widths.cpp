// Implementation of print_widths.h. A triangle gets one sample, its centroid, and in proportion to its area
// further ones from the Kronecker sequence (k g, k g^2) mod 1, where 1/g is the root of x^3 = x + 1 (the
// plastic number), folded into the triangle. Sample k of a triangle does not depend on other triangles.
#include "frep/geom/print_widths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "frep/base/parallel.h"
#include "frep/geom/bvh.h"

namespace frep {

namespace {

constexpr double absent = std::numeric_limits<double>::infinity();
constexpr std::size_t block_size = 512;          // triangles
constexpr std::size_t most_of_triangle = 65536;  // samples

struct Corners {
    Vec3 a, b, c;
};

Corners corners_of(const Mesh& mesh, std::size_t t) {
    const Triangle& tri = mesh.triangles[t];
    return {mesh.vertices[tri[0]], mesh.vertices[tri[1]], mesh.vertices[tri[2]]};
}

double size(double x) { return x < 0 ? -x : x; }

/// The unit normal, or zero for a triangle too thin for one: its height must be large against the rounding of
/// coordinates to binary32, so that the direction is right to about two degrees.
Vec3 normal_of(const Corners& t) {
    const Vec3 n = cross(t.b - t.a, t.c - t.a);
    const double longest =
        std::max({dot(t.b - t.a, t.b - t.a), dot(t.c - t.b, t.c - t.b), dot(t.a - t.c, t.a - t.c)});
    double largest = 0;
    for (const Vec3& p : {t.a, t.b, t.c}) largest = std::max({largest, size(p.x), size(p.y), size(p.z)});
    const double length_of_n = length(n);
    const double least_height = largest * 0x1p-19;
    if (!(length_of_n > least_height * __builtin_sqrt(longest)) || !(length_of_n <= 1e300)) return {0, 0, 0};
    return n / length_of_n;
}

Vec3 sample_of(const Corners& t, std::size_t k) {
    if (k == 0) return (t.a + t.b + t.c) / 3;
    constexpr double g = 0.7548776662466927, gg = 0.5698402909980532;
    double u = static_cast<double>(k) * g, v = static_cast<double>(k) * gg;
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return t.a + (t.b - t.a) * u + (t.c - t.a) * v;
}

/// A width that was found, with the area that its sample stands for.
struct Found {
    double width = absent, area = 0;
};

/// The findings of one block of triangles in one direction.
struct BlockResult {
    std::vector<Found> found;
    double smallest = absent;
    Vec3 from, to;
    std::size_t samples = 0;
};

/// How many samples each triangle gets.
class Plan {
  public:
    Plan(const Mesh& mesh, std::size_t samples) {
        double whole = 0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) whole += area(mesh, t);
        per_area_ = whole > 0 && whole <= 1e300 ? static_cast<double>(samples) / whole : 0;
    }
    std::size_t count(double area) const {
        const double wanted = area * per_area_;
        return wanted < 1 ? 1 : std::min(static_cast<std::size_t>(std::min(wanted, 1e9)), most_of_triangle);
    }
    static double area(const Mesh& mesh, std::size_t t) {
        const Corners c = corners_of(mesh, t);
        return length(cross(c.b - c.a, c.c - c.a)) / 2;
    }

  private:
    double per_area_ = 0;
};

/// Rays from the samples: through the material (walls) or through the empty space (gaps).
class Prober {
  public:
    Prober(const TriangleBvh& tree, const Plan& plan, bool walls, double facing_cosine)
        : tree_(tree), plan_(plan), walls_(walls), facing_cosine_(facing_cosine) {}

    void probe(std::size_t t, BlockResult& result) const {
        const Corners corners = corners_of(tree_.mesh(), t);
        const Vec3 normal = normal_of(corners);
        if (normal == Vec3{0, 0, 0}) return;
        const double area = Plan::area(tree_.mesh(), t);
        const std::size_t count = plan_.count(area);
        result.samples += count;
        for (std::size_t k = 0; k < count; ++k) {
            const Vec3 from = sample_of(corners, k);
            const double width = width_at(from, normal, static_cast<std::uint32_t>(t));
            if (width == absent) continue;
            result.found.push_back({width, area / static_cast<double>(count)});
            if (width >= result.smallest) continue;
            result.smallest = width;
            result.from = from;
            result.to = from + (walls_ ? -normal : normal) * width;
        }
    }

  private:
    double width_at(const Vec3& from, const Vec3& normal, std::uint32_t own) const {
        const Vec3 direction = walls_ ? -normal : normal;
        // Through the material a ray ends where it goes out, through empty space where it goes in.
        const auto ends = [&](std::uint32_t t) {
            if (t == own) return false;
            const Corners c = corners_of(tree_.mesh(), t);
            const double along = dot(cross(c.b - c.a, c.c - c.a), direction);
            return walls_ ? along > 0 : along < 0;
        };
        const auto hit = tree_.first_hit({from, direction}, ends);
        if (!hit || !(hit->t > 0)) return absent;
        const Vec3 other = normal_of(corners_of(tree_.mesh(), hit->triangle));
        return size(dot(other, direction)) >= facing_cosine_ ? hit->t : absent;
    }

    const TriangleBvh& tree_;
    const Plan& plan_;
    bool walls_;
    double facing_cosine_;
};

/// The width that `share` of the area does not reach.
double percentile(const std::vector<Found>& sorted, double whole, double share) {
    double sum = 0;
    for (const Found& f : sorted) {
        sum += f.area;
        if (sum >= share * whole) return f.width;
    }
    return sorted.empty() ? 0 : sorted.back().width;
}

WidthReport summary(std::vector<BlockResult>& blocks, double limit, std::size_t& samples) {
    WidthReport report;
    double smallest = absent;
    std::vector<Found> all;
    samples = 0;
    for (BlockResult& block : blocks) {
        samples += block.samples;
        all.insert(all.end(), block.found.begin(), block.found.end());
        block.found = {};
        if (block.smallest >= smallest) continue;
        smallest = block.smallest;
        report.smallest = MeasuredWidth{smallest, block.from, block.to};
    }
    std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
        return a.width != b.width ? a.width < b.width : a.area < b.area;
    });
    for (const Found& f : all) {
        report.measured_area_mm2 += f.area;
        if (f.width < limit) report.below_limit_area_mm2 += f.area;
    }
    report.p01_mm = percentile(all, report.measured_area_mm2, 0.01);
    report.median_mm = percentile(all, report.measured_area_mm2, 0.5);
    return report;
}

}  // namespace

Widths measure_widths(const Mesh& mesh, const WidthOptions& options, const Job& job) {
    Widths widths;
    const TriangleBvh tree(mesh, job);
    const Plan plan(mesh, options.samples);
    for (const bool walls : {true, false}) {
        if (job.cancelled()) return widths;
        const Prober prober(tree, plan, walls, options.facing_cosine);
        std::vector<BlockResult> blocks((mesh.triangles.size() + block_size - 1) / block_size);
        parallel_for(job, blocks.size(), [&](std::size_t b) {
            const std::size_t end = std::min(mesh.triangles.size(), (b + 1) * block_size);
            for (std::size_t t = b * block_size; t < end && !job.cancelled(); ++t) prober.probe(t, blocks[b]);
        });
        (walls ? widths.walls : widths.gaps) =
            summary(blocks, walls ? options.wall_limit : options.gap_limit, widths.samples);
    }
    return widths;
}

}  // namespace frep
