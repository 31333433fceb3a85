// Sums over key points and their rows. See skeletons.h; the kernels are field/kernels/skeleton.h.
#include "frep/shapes/skeletons.h"

#include "frep/shapes/binding.h"

namespace frep::shapes {

namespace {

constexpr const char* needs_equal = "x must have 3 items and the arrays of key points equal sizes";

/// A sum of `op` over points whose k-th data item is the k-th array's; nothing when sizes differ.
std::optional<Expression> point_sum(Build& build, Op op, Array x, std::initializer_list<Array> columns) {
    const std::size_t count = columns.begin()->size();
    for (const Array& column : columns)
        if (column.size() != count) return std::nullopt;
    if (x.size() != 3) return std::nullopt;
    std::vector<Expression> data;
    data.reserve(count * columns.size());
    for (std::size_t i = 0; i < count; ++i)
        for (const Array& column : columns) data.push_back(column[i]);
    return block(build, op, {x[0], x[1], x[2]}, data);
}

}  // namespace

Expression blobby(Build& build, Array x, Array x0, Array y0, Array z0, Array a, Array b,
                  Expression threshold) {
    const auto sum = point_sum(build, Op::blobby, x, {x0, y0, z0, a, b});
    return sum ? *sum - threshold : build.error(needs_equal);
}

Expression metaball(Build& build, Array x, Array x0, Array y0, Array z0, Array b, Array d,
                    Expression threshold) {
    const auto sum = point_sum(build, Op::metaball, x, {x0, y0, z0, b, d});
    return sum ? *sum - threshold : build.error(needs_equal);
}

Expression soft(Build& build, Array x, Array x0, Array y0, Array z0, Array d, Expression threshold) {
    const auto sum = point_sum(build, Op::soft, x, {x0, y0, z0, d});
    return sum ? *sum - threshold : build.error(needs_equal);
}

Expression fitted_blob(Build& build, Array x, Expression object, Array x0, Array y0, Array z0, Array object0,
                       Array sigma) {
    const auto sum = point_sum(build, Op::fitted_blob, x, {x0, y0, z0, object0, sigma});
    return sum ? object - *sum : build.error(needs_equal);
}

Rows skeleton_rows() {
    return {
        row<&blobby>("hfBlobby", "x, x0, y0, z0, a, b, T",
                     {"Blobs: exponentials about key points.", "sum b_i exp(-a_i r_i^2) - T", "blinn1982"}),
        row<&metaball>(
            "hfMetaball", "x, x0, y0, z0, b, d, T",
            {"Metaballs: piecewise quadratic bells of height b_i that end at distance d_i.",
             "sum m_i - T; q = r_i/d_i; m = b (1 - 3 q^2) for q <= 1/3, 1.5 b (1-q)^2 for q < 1, else 0",
             "nishimura1985", "The heights b come before the radii d. Points with d_i <= 0 are left out."}),
        row<&soft>("hfSoft", "x, x0, y0, z0, d, T",
                   {"Soft objects: bells of height 1 that end smoothly at distance d_i.",
                    "sum s_i - T; q = (r_i/d_i)^2; s = 1 - 22/9 q + 17/9 q^2 - 4/9 q^3 for q <= 1, else 0",
                    "wyvill1986"}),
        row<&fitted_blob>(
            "hfFMapBlob", "x, fobj, x0, y0, z0, fobj0, sigma",
            {"An object pulled through key points; fobj is its value at x, fobj0_i at key point i.",
             "fobj - sum fobj0_i / (1 + r_i^2 / sigma_i^2)", "savchenko1995",
             "Points with sigma_i <= 1e-6 are left out. The old C library had the file but not the name."}),
    };
}

}  // namespace frep::shapes
