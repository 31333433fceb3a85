// Implementation of print_check.h: sizes, overhangs and stand. Walls and gaps are in print_widths.cpp.
#include "frep/geom/print_check.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "frep/geom/mesh_check.h"
#include "frep/geom/print_widths.h"
#include "frep/math/functions.h"

namespace frep {

namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double tolerance_degrees = 0.5;

/// Two horizontal unit vectors and the unit vector up, right-handed.
struct Frame {
    Vec3 x, y, up;
    Vec2 flat(const Vec3& p) const { return {dot(p, x), dot(p, y)}; }
};

Frame frame_of(const Vec3& direction) {
    const Vec3 up = direction / length(direction);
    const bool steep = up.z > 0.9 || up.z < -0.9;
    const Vec3 side = cross(steep ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, up);
    const Vec3 x = side / length(side);
    return {x, cross(up, x), up};
}

/// A triangle of the mesh as it lies.
struct Face {
    Vec3 centroid, normal;  ///< the normal has length 1, or 0 without area
    double area = 0;
    double highest = 0;  ///< of its corners
};

Face face_of(const Mesh& mesh, const Triangle& t, const Vec3& up) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 n = cross(b - a, c - a);
    const double size = length(n);
    const double highest = std::max({dot(a, up), dot(b, up), dot(c, up)});
    return {(a + b + c) / 3, size > 0 ? n / size : Vec3{0, 0, 0}, size / 2, highest};
}

/// The slope of a face that looks down, degrees from the vertical.
double slope(const Face& face, const Vec3& up) {
    return math::asin(std::clamp(-dot(face.normal, up), -1.0, 1.0)) / degree;
}

/// `plate` is the height up to which things rest on the plate.
OverhangReport overhang_of(const Mesh& mesh, const Vec3& up, double plate, double angle, double mm) {
    OverhangReport report;
    double whole = 0, area = 0;
    std::vector<std::pair<double, Face>> steep;
    for (const Triangle& t : mesh.triangles) {
        const Face face = face_of(mesh, t, up);
        whole += face.area;
        if (face.area == 0 || face.highest <= plate) continue;
        const double degrees = slope(face, up);
        if (!(degrees > angle + tolerance_degrees)) continue;
        area += face.area;
        report.steepest = std::max(report.steepest, degrees);
        steep.emplace_back(degrees, face);
    }
    double largest = 0;
    for (const auto& [degrees, face] : steep) {
        if (degrees < report.steepest - 1 || face.area <= largest) continue;
        largest = face.area;
        report.worst = face.centroid;
    }
    report.area_mm2 = area * mm * mm;
    report.share = whole > 0 ? area / whole : 0;
    return report;
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    return u.x * v.y - u.y * v.x;
}

/// The corners of the convex hull, counter-clockwise (Andrew 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Vec2> hull;
    const auto add = [&hull](const Vec2& p, std::size_t fixed) {
        while (hull.size() > fixed && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const Vec2& p : points) add(p, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    hull.pop_back();
    return hull;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a, to = p - a;
    const double whole = along.x * along.x + along.y * along.y;
    const double t = whole > 0 ? std::clamp((to.x * along.x + to.y * along.y) / whole, 0.0, 1.0) : 0;
    const Vec2 rest = to - along * t;
    return __builtin_sqrt(rest.x * rest.x + rest.y * rest.y);
}

/// How far p lies inside the hull; negative outside, and when the hull has no area.
double margin(const Vec2& p, const std::vector<Vec2>& hull) {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = hull.size() >= 3;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
        inside = inside && turn(a, b, p) > 0;
        nearest = std::min(nearest, distance_to_segment(p, a, b));
    }
    return inside ? nearest : 0 - nearest;
}

StandReport stand_of(const Mesh& mesh, const MeshReport& shape, const Frame& frame, double plate, double mm) {
    StandReport report;
    std::vector<Vec2> resting;
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            const Vec3& p = mesh.vertices[v];
            if (dot(p, frame.up) <= plate) resting.push_back(frame.flat(p));
        }
        const Face face = face_of(mesh, t, frame.up);
        if (face.highest <= plate) area += face.area;
    }
    report.contact_area_mm2 = area * mm * mm;
    if (!shape.centroid || resting.empty()) return report;
    report.margin_mm = margin(frame.flat(*shape.centroid), convex_hull(std::move(resting))) * mm;
    report.stable = *report.margin_mm > 0;
    return report;
}

double longest_side(const Box3& box) {
    const Vec3 side = box.max - box.min;
    return std::max({side.x, side.y, side.z});
}

std::optional<SmallestComponent> smallest_of(const MeshReport& shape, double mm) {
    std::optional<SmallestComponent> smallest;
    for (const ComponentReport& component : shape.component_list) {
        const double size = longest_side(component.bounds) * mm;
        if (!smallest || size < smallest->size_mm) smallest = SmallestComponent{size, component.bounds};
    }
    return smallest;
}

bool is_angle(double degrees) { return degrees >= 0 && degrees <= 90; }

Status checked(const PrintCheckOptions& options) {
    const auto wrong = [](const char* message) { return Error{ErrorKind::invalid_argument, message}; };
    if (!(options.unit.metres > 0 && options.unit.metres < 1e300))
        return wrong("the length unit has no size");
    const double up = length(options.up);
    if (!(up > 0 && up < 1e300)) return wrong("the direction up has no length");
    if (!is_angle(options.overhang_angle)) return wrong("the overhang angle is not between 0 and 90 degrees");
    if (!is_angle(options.facing_angle)) return wrong("the facing angle is not between 0 and 90 degrees");
    if (!(options.plate_tolerance_mm >= 0)) return wrong("the tolerance at the build plate is negative");
    return {};
}

}  // namespace

Result<PrintReport> print_check(const Mesh& mesh, const PrintCheckOptions& options, const Job& job) {
    if (Status status = checked(options); !status) return status.error();
    FREP_CHECK(is_valid(mesh));
    Mesh bare;
    bare.vertices = mesh.vertices;
    bare.triangles = mesh.triangles;
    const Mesh merged = merge_equal_positions(bare, {.as_float32 = options.as_float32});
    const MeshReport shape = check(merged, {.as_float32 = false});

    PrintReport report;
    const double mm = report.mm_per_unit = options.unit.metres * 1000;
    report.components = shape.components;
    if (!shape.bounds) return report;
    report.size_mm = (shape.bounds->max - shape.bounds->min) * mm;
    const Frame frame = frame_of(options.up);
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Triangle& t : merged.triangles) {
        for (const std::uint32_t v : t) {
            lowest = std::min(lowest, dot(merged.vertices[v], frame.up));
            highest = std::max(highest, dot(merged.vertices[v], frame.up));
        }
    }
    report.height_mm = (highest - lowest) * mm;
    const double plate = lowest + options.plate_tolerance_mm / mm;
    report.overhang = overhang_of(merged, frame.up, plate, options.overhang_angle, mm);
    report.stand = stand_of(merged, shape, frame, plate, mm);
    report.smallest_component = smallest_of(shape, mm);

    WidthOptions widths;
    widths.facing_cosine = math::cos(options.facing_angle * degree);
    widths.wall_limit = options.min_wall_mm / mm;
    widths.gap_limit = options.min_gap_mm / mm;
    widths.samples = options.samples;
    const Widths measured = measure_widths(merged, widths, job);
    if (job.cancelled()) return Error{ErrorKind::cancelled, "the print check was cancelled"};
    const auto in_mm = [mm](WidthReport w) {
        if (w.smallest) w.smallest->length_mm *= mm;
        w.p01_mm *= mm;
        w.median_mm *= mm;
        w.measured_area_mm2 *= mm * mm;
        w.below_limit_area_mm2 *= mm * mm;
        return w;
    };
    report.walls = in_mm(measured.walls);
    report.gaps = in_mm(measured.gaps);
    report.samples = measured.samples;
    return report;
}

}  // namespace frep
