// Free-form volumes and their rows. See freeform.h.
#include "frep/shapes/freeform.h"

#include <array>

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr std::size_t largest_net = 21;
constexpr double padding_value = -15.0;
constexpr std::size_t padding_layers = 3;

/// A whole number in 1..limit that is the same for every point, rounded as the language rounds indexes.
std::optional<std::size_t> count_of(Build& build, Expression value, std::size_t limit) {
    const auto number = known(build, value);
    if (!number || !(*number >= 0.5) || !(*number < static_cast<double>(limit) + 0.5)) return std::nullopt;
    return static_cast<std::size_t>(*number + 0.5);
}

/// R-intersection of the three slabs of a box: ((xmax-x)(x-xmin) & (ymax-y)(y-ymin)) & (zmax-z)(z-zmin).
Expression box_solid(Array x, const std::array<Expression, 3>& low, const std::array<Expression, 3>& high) {
    Expression slab[3];
    for (std::size_t i = 0; i < 3; ++i) slab[i] = (high[i] - x[i]) * (x[i] - low[i]);
    return r_and(r_and(slab[0], slab[1]), slab[2]);
}

struct Net {
    std::size_t l, m, n;
};
std::optional<Net> net_of(Build& build, Expression l, Expression m, Expression n, Array values) {
    const auto a = count_of(build, l, largest_net), b = count_of(build, m, largest_net),
               c = count_of(build, n, largest_net);
    if (!a || !b || !c || values.size() != *a * *b * *c) return std::nullopt;
    return Net{*a, *b, *c};
}

constexpr const char* needs_net =
    "x must have 3 items, the box 6, the control values l m n, with l, m, n known whole numbers of 1..21";

/// The control net inside `padding_layers` layers of padding_value on every side.
std::vector<Expression> padded(Build& build, const Net& net, Array values) {
    const std::size_t l = net.l + 2 * padding_layers, m = net.m + 2 * padding_layers,
                      n = net.n + 2 * padding_layers;
    std::vector<Expression> out(l * m * n, build.constant(padding_value));
    for (std::size_t i = 0; i < net.l; ++i)
        for (std::size_t j = 0; j < net.m; ++j)
            for (std::size_t k = 0; k < net.n; ++k)
                out[((i + padding_layers) * m + j + padding_layers) * n + k + padding_layers] =
                    values[(i * net.m + j) * net.n + k];
    return out;
}

std::vector<Expression> with_sizes(Build& build, std::initializer_list<std::size_t> sizes, Array values) {
    std::vector<Expression> data;
    for (const std::size_t size : sizes) data.push_back(build.constant(static_cast<double>(size)));
    data.insert(data.end(), values.begin(), values.end());
    return data;
}

Expression voxels(Build& build, Array x, std::string_view file, std::array<std::size_t, 3> size,
                  Expression level) {
    if (x.size() != 3) return build.error("x must have 3 items");
    if (!build.read_file) return build.error("there is no file access here");
    const Result<std::string> bytes = build.read_file(file);
    if (!bytes) return build.error(bytes.error().message);
    if (bytes->size() != size[0] * size[1] * size[2])
        return build.error("the voxel file has another size than its dimensions say");
    std::vector<Expression> levels(256);
    for (int i = 0; i < 256; ++i) levels[static_cast<std::size_t>(i)] = build.constant(i);
    std::vector<Expression> values;
    values.reserve(bytes->size());
    for (const char c : *bytes) values.push_back(levels[static_cast<unsigned char>(c)]);
    std::array<Expression, 3> at;  // grid units: the first and last sample lie on the box
    for (std::size_t i = 0; i < 3; ++i) at[i] = (x[i] + 1.0) * (0.5 * static_cast<double>(size[i] - 1));
    return block(build, Op::voxels, {at[0], at[1], at[2]},
                 with_sizes(build, {size[0], size[1], size[2]}, values)) -
           level;
}

}  // namespace

Expression bezier_volume(Build& build, Array x, Expression l, Expression m, Expression n, Array box,
                         Array values) {
    const auto net = net_of(build, l, m, n, values);
    if (!net || !sizes_are({{x, 3}, {box, 6}})) return build.error(needs_net);
    std::array<Expression, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = (x[i] - box[i]) / (box[i + 3] - box[i]);
    const Expression sum = block(build, Op::bezier_volume, {at[0], at[2], at[1]},
                                 with_sizes(build, {net->l, net->m, net->n}, values));
    return r_and(box_solid(x, {box[0], box[1], box[2]}, {box[3], box[4], box[5]}), sum);
}

Expression bspline_volume(Build& build, Array x, Expression l, Expression m, Expression n, Array box,
                          Array values) {
    const auto net = net_of(build, l, m, n, values);
    if (!net || net->l < 2 || net->m < 2 || net->n < 2 || !sizes_are({{x, 3}, {box, 6}}))
        return build.error(needs_net);
    const std::size_t count[3] = {net->l, net->n, net->m};  // x with l, y with n, z with m
    std::array<Expression, 3> at, low, high;
    for (std::size_t i = 0; i < 3; ++i) {
        const Expression cell = (box[i + 3] - box[i]) / static_cast<double>(count[i] - 1);
        low[i] = box[i] - 3.0 * cell;
        high[i] = box[i + 3] + 3.0 * cell;
        const double knots = static_cast<double>(count[i] + 2 * padding_layers - 3);
        at[i] = (x[i] - low[i]) / (high[i] - low[i]) * knots;
    }
    const Expression sum = block(
        build, Op::bspline_volume, {at[0], at[2], at[1]},
        with_sizes(build,
                   {net->l + 2 * padding_layers, net->m + 2 * padding_layers, net->n + 2 * padding_layers},
                   padded(build, *net, values)));
    return r_and(box_solid(x, low, high), sum);
}

Expression voxels_old(Build& build, Array x, std::string_view file, Expression level) {
    return voxels(build, x, file, {150, 200, 192}, level);
}

Expression voxels_sized(Build& build, Array x, std::string_view file, Expression nx, Expression ny,
                        Expression nz, Expression level) {
    constexpr std::size_t most = 100'000;
    const auto a = count_of(build, nx, most), b = count_of(build, ny, most), c = count_of(build, nz, most);
    if (!a || !b || !c || *a < 2 || *b < 2 || *c < 2)
        return build.error("nx, ny, nz must be known whole numbers above 1");
    return voxels(build, x, file, {*a, *b, *c}, level);
}

Rows freeform_rows() {
    return {
        row<&bezier_volume>(
            "hfBezierVolume", "x, l, m, n, bbox, w",
            {"Bezier volume: a Bernstein sum of l m n control values over a box, inside that box.",
             "cube & sum w[i m n + j n + k] B_i(u) B_j(t) B_k(v), u, v, t = x, y, z scaled to 0..1",
             "miura1996",
             "l, m, n are numbers of control values, at most 21. i runs with x, j with z, k with y."}),
        row<&bspline_volume>(
            "hfCubicBSpline", "x, l, m, n, bbox, w",
            {"Cubic B-spline volume: l m n control values inside three layers of value -15.",
             "cube & sum w[i m n + j n + k] N_i(u) N_j(t) N_k(v) over the box enlarged by 3 cells a side",
             "miura1996",
             "End knots are fourfold. The old C library had the file but not the name; it enlarged the "
             "caller's "
             "box at each call, which does not happen here."}),
        row<&voxels_old>("hfVoxel", "x, file, level",
                         {"Solid of a raw file of 150 x 200 x 192 bytes over [-1,1]^3.",
                          "trilinear density - level; density 0 outside the box", "",
                          "The file is named relative to the model's folder. The old file name was fixed."}),
        row<&voxels_sized>("hfVoxel", "x, file, nx, ny, nz, level",
                           {"Solid of a raw file of nx x ny x nz bytes (x fastest) over [-1,1]^3.",
                            "trilinear density - level; density 0 outside the box"}),
    };
}

}  // namespace frep::shapes
