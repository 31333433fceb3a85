// Sums over key points: shapes of the bells, points without extent, fitted blobs.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {
double bell(Op op, double r, std::vector<double> rest) {
    std::vector<double> block = {0, 0, 0};
    block.insert(block.end(), rest.begin(), rest.end());
    return meaning<double>(op, std::vector<double>{r, 0, 0}, block);
}
}  // namespace

TEST_CASE("bells at some distances") {
    CHECK(bell(Op::blobby, 1, {2, 3}) == Approx(3 * std::exp(-2.0)));
    CHECK(bell(Op::metaball, 0, {2, 3}) == 2);
    CHECK(bell(Op::metaball, 1, {2, 3}) == Approx(2 * 2.0 / 3));
    CHECK(bell(Op::metaball, 2, {2, 3}) == Approx(3 * (1.0 / 9)));
    CHECK(bell(Op::metaball, 3, {2, 3}) == 0);
    CHECK(bell(Op::metaball, 4, {2, 3}) == 0);
    CHECK(bell(Op::soft, 0, {2}) == 1);
    CHECK(bell(Op::soft, 1, {2}) == Approx(0.5));
    CHECK(bell(Op::soft, 2, {2}) == Approx(0));
    CHECK(bell(Op::soft, 3, {2}) == 0);
    CHECK(bell(Op::fitted_blob, 1, {2, 1}) == 1);
}

TEST_CASE("points without extent are left out; undefined data are not") {
    for (const double d : {0.0, -1.0}) {
        CHECK(bell(Op::metaball, 0, {2, d}) == 0);
        CHECK(bell(Op::soft, 0, {d}) == 0);
        CHECK(bell(Op::fitted_blob, 0, {2, d}) == 0);
    }
    CHECK(std::isnan(bell(Op::metaball, 0, {2, std::nan("")})));
    CHECK(std::isnan(bell(Op::soft, 0, {std::nan("")})));
    CHECK(std::isnan(bell(Op::soft, std::nan(""), {2})));
    CHECK(std::isnan(bell(Op::metaball, std::nan(""), {2, 3})));
}

TEST_CASE("the old calls") {
    Sketch s;
    Items px = s.list({0, 1}), py = s.list({0, 0.5}), pz = s.list({0, -0.5}), a = s.list({1, 2}),
          b = s.list({3, 4});
    CHECK(at(s.call("hfBlobby", {s.x, px, py, pz, a, b, 0.5}), 1, 0.5, -0.5) ==
          Approx(3 * std::exp(-1.5) + 4 - 0.5));
    // an object pulled to 0 at a key point
    Items x0 = s.list({1}), y0 = s.list({0}), z0 = s.list({0}), f0 = s.list({-3}), sigma = s.list({0.1});
    const Expression object = -2.0 * s.x[0] - 1.0;
    CHECK(at(s.call("hfFMapBlob", {s.x, object, x0, y0, z0, f0, sigma}), 1, 0, 0) == 0);
    // key points may be fields
    Items moving = {s.x[1]};
    CHECK(at(s.call("hfSoft", {s.x, moving, y0, z0, x0, 0.0}), 2, 2, 0) == Approx(0).epsilon(1));
}
