// Affine maps and their rows. See affine.h.
#include "frep/shapes/affine.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr const char* needs_triples = "the array to transform, the point and the direction must have 3 items";

Expression done(Build& build) { return build.constant(1.0); }

void assign(ArrayInOut point, Vec3x v) {
    point[0] = v.x;
    point[1] = v.y;
    point[2] = v.z;
}
Vec3x operator+(Vec3x a, Vec3x b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3x operator*(Expression s, Vec3x a) { return {s * a.x, s * a.y, s * a.z}; }

bool surely_zero(Build& build, Expression value) {
    const auto number = build.graph.constant_value(value.id());
    return number && *number == 0.0;
}

/// The plane's side distance times the normal's length, and the reflection's factor of the normal.
template <class Part>
Expression reflect(Build& build, ArrayInOut point, Array origin, Array normal, Part part) {
    if (!sizes_are({{Array(point), 3}, {origin, 3}, {normal, 3}})) return build.error(needs_triples);
    const Vec3x n = vec3(normal), p = vec3(Array(point));
    if (surely_zero(build, norm2(n))) return build.error("the normal has length 0");
    const Expression height = dot(p - vec3(origin), n);
    assign(point, p - (part(height) * 2.0 / norm2(n)) * n);
    return done(build);
}

}  // namespace

Expression rotate_about(Build& build, ArrayInOut point, Array origin, Array direction, Expression angle) {
    if (!sizes_are({{Array(point), 3}, {origin, 3}, {direction, 3}})) return build.error(needs_triples);
    const Vec3x d = vec3(direction);
    const Expression length = sqrt(norm2(d));
    if (surely_zero(build, length)) return build.error("the direction has length 0");
    const Vec3x u = {d.x / length, d.y / length, d.z / length};
    const Vec3x v = vec3(Array(point)) - vec3(origin);
    // back by the angle: v cos - (u x v) sin + u (u.v)(1 - cos)
    const Expression c = cos(angle), s = sin(angle);
    assign(point, vec3(origin) + (c * v + s * cross(v, u)) + (dot(u, v) * (1.0 - c)) * u);
    return done(build);
}

template <int axis>
Expression shear(Build& build, ArrayInOut point, Expression s1, Expression s2) {
    if (point.size() != 3) return build.error("the array to transform must have 3 items");
    constexpr std::size_t first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    point[axis] = point[axis] - s1 * point[first] - s2 * point[second];
    return done(build);
}

Expression affine(Build& build, ArrayInOut point, Array matrix) {
    if (point.size() != 3 || matrix.size() != 12)
        return build.error("the array to transform must have 3 items and the matrix 12");
    const Vec3x row[3] = {vec3(matrix.subspan(0)), vec3(matrix.subspan(4)), vec3(matrix.subspan(8))};
    const Vec3x shifted = vec3(Array(point)) - Vec3x{matrix[3], matrix[7], matrix[11]};
    // the columns of the inverse matrix are the vector products of the rows over the determinant
    const Vec3x columns[3] = {cross(row[1], row[2]), cross(row[2], row[0]), cross(row[0], row[1])};
    const Expression determinant = dot(row[0], columns[0]);
    if (surely_zero(build, determinant)) return build.error("the matrix has no inverse");
    assign(point, ((shifted.x / determinant) * columns[0] + (shifted.y / determinant) * columns[1]) +
                      (shifted.z / determinant) * columns[2]);
    return done(build);
}

Expression mirror(Build& build, ArrayInOut point, Array origin, Array normal) {
    return reflect(build, point, origin, normal, [](Expression height) { return height; });
}

Expression fold(Build& build, ArrayInOut point, Array origin, Array normal) {
    return reflect(build, point, origin, normal, [](Expression height) { return min(height, 0.0); });
}

Rows affine_rows() {
    constexpr std::string_view shear_note = "Volumes stay.";
    return {
        row<&rotate_about>(
            "hfRotate3D", "xt, p, d, theta",
            {"Turns the solid about the line through p along d, by radians, counter-clockwise against d.",
             "p + v cos + (v x u) sin + u (u . v)(1 - cos), v = x - p, u = d/|d|",
             {},
             "d may have any length but 0."},
            false),
        row<&shear<0>>(
            "hfShearX", "xt, sy, sz",
            {"Shears along x: each point moves by sy y + sz z.", "x - sy y - sz z", "barr1984", shear_note},
            false),
        row<&shear<1>>(
            "hfShearY", "xt, sx, sz",
            {"Shears along y: each point moves by sx x + sz z.", "y - sx x - sz z", "barr1984", shear_note},
            false),
        row<&shear<2>>(
            "hfShearZ", "xt, sx, sy",
            {"Shears along z: each point moves by sx x + sy y.", "z - sx x - sy y", "barr1984", shear_note},
            false),
        row<&affine>("hfAffine3D", "xt, m",
                     {"The affine map of the solid with the matrix m, {m11, m12, m13, t1, m21, ..., t3}.",
                      "M^-1 (x - T)",
                      {},
                      "Values are those of the point that is mapped here: a scale changes slopes."},
                     false),
        row<&mirror>("hfMirror3D", "xt, p, n",
                     {"Reflects the solid at the plane through p across n.",
                      "x - 2 (x - p).n/(n.n) n",
                      {},
                      "For the solid with its image: its union with the reflected one, or hfFold3D."},
                     false),
        row<&fold>("hfFold3D", "xt, p, n",
                   {"Folds space at the plane through p: the side that n points to appears on both sides.",
                    "x - 2 min((x - p).n, 0)/(n.n) n",
                    {},
                    "What lies on the other side is lost; a solid that crosses the plane is cut there."},
                   false),
    };
}

}  // namespace frep::shapes
