// Convolution surfaces and their rows. See convolution.h.
#include "frep/shapes/convolution.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr double pi = 3.14159265358979323846;

void append(std::vector<Expression>& data, Array items, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) data.push_back(items[first + i]);
}

Expression s_cubed(Expression s) { return s * square(s); }

Expression conv(Build& build, Op op, Array x, const std::vector<Expression>& data) {
    return block(build, op, {x[0], x[1], x[2]}, data);
}

/// Coordinate `axis` of the vertex with a one-based number, which is usually known.
Expression vertex_item(Build& build, Array vertices, Expression number, std::size_t axis) {
    const std::size_t count = vertices.size() / 3;
    if (const auto value = build.graph.constant_value(number.id())) {
        const double index = *value + 0.5;
        if (index >= 1.0 && index < static_cast<double>(count + 1))
            return vertices[3 * (static_cast<std::size_t>(index) - 1) + axis];
    }
    std::vector<Expression> items;
    for (std::size_t i = 0; i < count; ++i) items.push_back(vertices[3 * i + axis]);
    return block(build, Op::pick, {number}, items);
}

/// `v` turned by the angle of cosine c and sine s about the unit vector k (Rodrigues).
Vec3x turned(Vec3x v, Vec3x k, Expression c, Expression s) {
    const Vec3x kv = cross(k, v);
    const Expression along = dot(k, v) * (1.0 - c);
    return {v.x * c + kv.x * s + k.x * along, v.y * c + kv.y * s + k.y * along,
            v.z * c + kv.z * s + k.z * along};
}

}  // namespace

Expression conv_point(Build& build, Array x, Array points, Array s, Expression threshold) {
    if (!sizes_are({{x, 3}, {points, 3 * s.size()}}))
        return build.error("x must have 3 items and the points 3 for every item of S");
    std::vector<Expression> data;
    for (std::size_t i = 0; i < s.size(); ++i) {
        append(data, points, 3 * i, 3);
        data.push_back(s[i]);
    }
    return conv(build, Op::conv_point, x, data) - threshold;
}

Expression conv_line(Build& build, Array x, Array begin, Array end, Array s, Expression threshold) {
    if (!sizes_are({{x, 3}, {begin, 3 * s.size()}, {end, 3 * s.size()}}))
        return build.error("x must have 3 items, begin and end 3 for every item of S");
    std::vector<Expression> data;
    for (std::size_t i = 0; i < s.size(); ++i) {
        append(data, begin, 3 * i, 3);
        append(data, end, 3 * i, 3);
        data.push_back(s[i]);
    }
    return conv(build, Op::conv_line, x, data) - threshold;
}

Expression conv_curve(Build& build, Array x, Array points, Array s, Expression threshold) {
    if (!sizes_are({{x, 3}, {points, 3 * (s.size() + 1)}}))
        return build.error("x must have 3 items and the polyline 3 more than 3 for every item of S");
    std::vector<Expression> data;
    for (std::size_t i = 0; i < s.size(); ++i) {
        append(data, points, 3 * i, 6);
        data.push_back(s[i]);
    }
    return conv(build, Op::conv_line, x, data) - threshold;
}

template <bool weighted>
Expression conv_triangle(Build& build, Array x, Array points, Array s, Expression threshold) {
    if (!sizes_are({{x, 3}, {points, 9 * s.size()}}))
        return build.error("x must have 3 items and the triangles 9 for every item of S");
    std::vector<Expression> data;
    for (std::size_t i = 0; i < s.size(); ++i) {
        append(data, points, 9 * i, 9);
        data.push_back(s[i]);
        data.push_back(weighted ? s_cubed(s[i]) : build.constant(1.0));
    }
    return conv(build, Op::conv_triangle, x, data) - threshold;
}

template <bool weighted>
Expression conv_mesh(Build& build, Array x, Array vertices, Array triangles, Array s, Expression threshold) {
    if (!sizes_are({{x, 3}, {triangles, 3 * s.size()}}) || vertices.size() % 3 != 0)
        return build.error("x must have 3 items, the vertices 3 each, the triangles 3 for every item of S");
    std::vector<Expression> data;
    for (std::size_t i = 0; i < s.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t axis = 0; axis < 3; ++axis)
                data.push_back(vertex_item(build, vertices, triangles[3 * i + corner], axis));
        data.push_back(s[i]);
        data.push_back(weighted ? s_cubed(s[i]) : build.constant(1.0));
    }
    return conv(build, Op::conv_triangle, x, data) - threshold;
}

template <bool by_length>
Expression conv_arc(Build& build, Array x, Array center, Array radius, Array theta, Array axis, Array angle,
                    Array s, Expression threshold) {
    const std::size_t n = s.size();
    if (!sizes_are({{x, 3}, {center, 3 * n}, {radius, n}, {theta, n}, {axis, 3 * n}, {angle, n}}))
        return build.error("x must have 3 items; center and axis 3, the others 1 for every item of S");
    const Expression zero = build.constant(0.0), one = build.constant(1.0);
    std::vector<Expression> data;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3x a = vec3(axis.subspan(3 * i, 3));
        const Expression length = sqrt(norm2(a));
        // a rotation axis of length 0 leaves the frame unturned
        const Expression scale = select(equal(length, zero), zero, one / length);
        const Vec3x k = {a.x * scale, a.y * scale, a.z * scale};
        const Expression turn = angle[i] * (pi / 180.0);
        const Expression c = select(equal(length, zero), one, cos(turn)), sine = sin(turn);
        // local coordinates turn the point by -angle: the frame itself is turned by +angle
        const Vec3x e1 = turned({one, zero, zero}, k, c, sine);
        const Vec3x e2 = turned({zero, one, zero}, k, c, sine);
        append(data, center, 3 * i, 3);
        for (const Expression& item : {e1.x, e1.y, e1.z, e2.x, e2.y, e2.z}) data.push_back(item);
        data.push_back(radius[i]);
        data.push_back(min(max(theta[i], 0.0), 360.0) * (pi / 180.0));
        data.push_back(s[i]);
        data.push_back(by_length ? radius[i] : one);
    }
    return conv(build, Op::conv_arc, x, data) - threshold;
}

Expression conv_line_radius(Build& build, Array x, Array begin, Array end, Expression radius) {
    if (x.size() != 3 || begin.size() != end.size() || begin.size() % 3 != 0 || begin.empty())
        return build.error("x must have 3 items, begin and end equally many triples");
    const Expression zero = build.constant(0.0);
    const Expression s = select(less(radius, 1.0), 1.0 / radius, build.constant(1.0));
    std::vector<Expression> data;
    for (std::size_t i = 0; i < begin.size(); i += 3) {
        append(data, begin, i, 3);
        append(data, end, i, 3);
    }
    const Expression sum = block(build, Op::conv_line_clamped, {x[0], x[1], x[2], s}, data);
    // the threshold: the last segment, seen from distance R beside its end
    const std::size_t last = begin.size() - 3;
    const Expression length = sqrt(norm2(vec3(end.subspan(last, 3)) - vec3(begin.subspan(last, 3))));
    const std::vector<Expression> probe = {zero, zero, zero, length, zero, zero, s};
    return sum - block(build, Op::conv_line, {zero, radius, zero}, probe);
}

Rows convolution_rows() {
    constexpr std::string_view from = "mccormack1998";
    constexpr std::string_view cubed = "The integral is multiplied by S^3 for old files; ";
    static const std::string triangle_note = std::string(cubed) + "hfConvTriangleExact is without it.";
    static const std::string mesh_note = std::string(cubed) + "hfConvMeshExact is without it.";
    constexpr std::string_view arc_doc =
        "Arcs of theta degrees from the local x axis, frame turned by angle degrees about axis.";
    return {
        row<&conv_point>("hfConvPoint", "x, vect, S, T",
                         {"Convolution of points.", "sum 1/(1 + S_i^2 r_i^2)^2 - T", from}),
        row<&conv_line>("hfConvLine", "x, begin, end, S, T",
                        {"Convolution of line segments.", "sum integral of 1/(1 + S_i^2 r^2)^2 ds - T", from,
                         "A segment of length 0 counts 0 (the old tools stopped there)."}),
        row<&conv_curve>("hfConvCurve", "x, vect, S, T",
                         {"Convolution of a polyline of one segment for each item of S.",
                          "sum integral of 1/(1 + S_i^2 r^2)^2 ds - T", from}),
        row<&conv_triangle<true>>("hfConvTriangle", "x, vect, S, T",
                                  {"Convolution of triangles.",
                                   "sum S_i^3 integral of 1/(1 + S_i^2 r^2)^2 dA - T", from, triangle_note}),
        row<&conv_triangle<false>>("hfConvTriangleExact", "x, vect, S, T",
                                   {"Convolution of triangles: the true integral over the area.",
                                    "sum integral of 1/(1 + S_i^2 r^2)^2 dA - T", from},
                                   false),
        row<&conv_mesh<true>>("hfConvMesh", "x, vect, tri, S, T",
                              {"Convolution of the triangles of a mesh; tri holds one-based vertex numbers.",
                               "sum S_i^3 integral of 1/(1 + S_i^2 r^2)^2 dA - T", from, mesh_note}),
        row<&conv_mesh<false>>("hfConvMeshExact", "x, vect, tri, S, T",
                               {"Convolution of the triangles of a mesh: the true integral over the area.",
                                "sum integral of 1/(1 + S_i^2 r^2)^2 dA - T", from},
                               false),
        row<&conv_arc<false>>(
            "hfConvArc", "x, center, radius, theta, axis, angle, S, T",
            {arc_doc, "sum integral over 0..theta_i of 1/(1 + S_i^2 r^2)^2 d phi - T", from,
             "The integral is over the angle, not the arc length; hfConvArcLength is over the length."}),
        row<&conv_arc<true>>(
            "hfConvArcLength", "x, center, radius, theta, axis, angle, S, T",
            {arc_doc, "sum radius_i integral over 0..theta_i of 1/(1 + S_i^2 r^2)^2 d phi - T", from}, false),
        row<&conv_line_radius>(
            "hfConvLineR", "x, begin, end, R",
            {"Segments with the surface at about distance R from their ends.",
             "sum, clamped to 1 as it grows, of the integrals with S = 1/R (1 if R >= 1), minus the integral "
             "of the last segment seen from distance R beside its end",
             from}),
    };
}

}  // namespace frep::shapes
