// Free-form volumes: Bernstein identities, B-spline partition of unity and linear precision, voxels.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

double op_value(Op op, double u, double v, double w, const std::vector<double>& block) {
    return meaning<double>(op, std::vector<double>{u, v, w}, block);
}

}  // namespace

TEST_CASE("Bezier volumes: constants, corners, linear precision") {
    std::vector<double> net = {3, 4, 2};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 2; ++k) net.push_back(i / 2.0 + 10 * j / 3.0 - 5 * k);
    for (const double u : {-0.2, 0.0, 0.3, 1.0, 1.4})
        CHECK(op_value(Op::bezier_volume, u, 0.6, 0.2, net) == Approx(u + 6 - 1).epsilon(1e-13));
    CHECK(std::isnan(op_value(Op::bezier_volume, std::nan(""), 0, 0, net)));
    Sketch s;
    Items box = s.list({-1, -1, -1, 1, 1, 1}), w(8, s.number(-2));
    w[1] = s.number(5);  // i = 0, j = 0, k = 1: low x, low z, high y
    CHECK(at(s.call("hfBezierVolume", {s.x, 2, 2, 2, box, w}), -1, 1, -1) == Approx(0));
    CHECK(at(s.call("hfBezierVolume", {s.x, 2, 2, 2, box, w}), -0.98, 0.98, -0.98) > 0);
    CHECK(at(s.call("hfBezierVolume", {s.x, 2, 2, 2, box, w}), -0.98, -0.98, 0.98) < 0);
    CHECK(s.warnings.empty());
    CHECK(at(s.call("hfBezierVolume", {s.x, 2, 2, 3, box, w}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfBezierVolume", {s.x, 2, s.x[0], 2, box, w}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 2);
}

TEST_CASE("B-spline volumes: partition of unity, ends, linear precision") {
    const int l = 7, m = 5, n = 4;
    std::vector<double> ones = {l, m, n}, linear = ones;
    const auto greville = [](int i, int count) {  // mean of three knots
        double sum = 0;
        for (int j = 1; j <= 3; ++j) sum += std::min(std::max(i + j - 3, 0), count - 3);
        return sum / 3;
    };
    for (int i = 0; i < l; ++i)
        for (int j = 0; j < m; ++j)
            for (int k = 0; k < n; ++k) {
                ones.push_back(1);
                linear.push_back(greville(i, l) - 2 * greville(j, m) + 3 * greville(k, n));
            }
    for (const double u : {0.0, 0.1, 1.0, 1.7, 2.5, 3.9, 4.0}) {
        CHECK(op_value(Op::bspline_volume, u, 1.2, 0.4, ones) == Approx(1).epsilon(1e-14));
        CHECK(op_value(Op::bspline_volume, u, 1.2, 0.4, linear) == Approx(u - 2.4 + 1.2).epsilon(1e-13));
    }
    CHECK(op_value(Op::bspline_volume, 9, 1.2, 0.4, linear) ==
          op_value(Op::bspline_volume, 4, 1.2, 0.4, linear));
    CHECK(std::isnan(op_value(Op::bspline_volume, std::nan(""), 1.2, 0.4, linear)));
    Sketch s;
    Items box = s.list({-1, -1, -1, 1, 1, 1}), w(27, s.number(20));
    const Expression f = s.call("hfCubicBSpline", {s.x, 3, 3, 3, box, w});
    CHECK(at(f, 0, 0, 0) > 0);
    CHECK(at(f, 3, 0, 0) < 0);
    CHECK(at(f, 9, 0, 0) < 0);
    CHECK(s.warnings.empty());
}

TEST_CASE("spline control values may be fields") {
    Sketch s;
    Items box = s.list({-1, -1, -1, 1, 1, 1}), w(27, s.x[2]), c(27, s.number(0.25));
    const Expression f = s.call("hfCubicBSpline", {s.x, 3, 3, 3, box, w});
    const Expression g = s.call("hfCubicBSpline", {s.x, 3, 3, 3, box, c});
    CHECK(at(f, 0.2, 0.3, 0.25) == at(g, 0.2, 0.3, 0.25));
}

TEST_CASE("voxels") {
    Sketch s;
    std::string file(3 * 4 * 5, '\0');
    for (std::size_t i = 0; i < file.size(); ++i) file[i] = static_cast<char>(i * 37 % 256);
    s.build.read_file = [&](std::string_view name) -> Result<std::string> {
        if (name != "a.vol") return Error{ErrorKind::io, "no such file"};
        return file;
    };
    const Expression f = s.call("hfVoxel", {s.x, "a.vol", 3, 4, 5, 10.0});
    const auto sample = [&](int i, int j, int k) {
        return static_cast<unsigned char>(file[static_cast<std::size_t>((k * 4 + j) * 3 + i)]) - 10.0;
    };
    CHECK(at(f, -1, -1, -1) == sample(0, 0, 0));
    CHECK(at(f, 1, 1, 1) == sample(2, 3, 4));
    CHECK(at(f, 0, -1, -1) == sample(1, 0, 0));
    CHECK(at(f, 0.5, -1, 0) == Approx(0.5 * (sample(1, 0, 2) + sample(2, 0, 2))));
    CHECK(at(f, 1.01, 0, 0) == -10);
    CHECK(std::isnan(at(f, std::nan(""), 0, 0)));
    CHECK(s.warnings.empty());
    CHECK(at(s.call("hfVoxel", {s.x, "b.vol", 3, 4, 5, 10.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfVoxel", {s.x, "a.vol", 3, 4, 6, 10.0}), 0, 0, 0) == shapes::error_value);
    CHECK(at(s.call("hfVoxel", {s.x, "a.vol", 10.0}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 3);
    Sketch without;
    CHECK(at(without.call("hfVoxel", {without.x, "a.vol", 10.0}), 0, 0, 0) == shapes::error_value);
}
