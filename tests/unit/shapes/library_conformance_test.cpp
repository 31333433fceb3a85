// Values of the old library, from tests/conformance/library, for one model of each group built by hand. The
// language tests run all of them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;

namespace {

/// Compares with NAME.values.txt, lines "x y z -> F".
void compare(const std::string& name, const std::function<Expression(Sketch&)>& make,
             double tolerance = 1e-9) {
    CAPTURE(name);
    Sketch s;
    const Expression f = make(s);
    std::istringstream lines(
        content_of(FREP_SOURCE_DIR "/tests/conformance/library/" + name + ".values.txt"));
    int count = 0;
    double x, y, z, expected;
    std::string arrow;
    while (lines >> x >> y >> z >> arrow >> expected) {
        ++count;
        const double value = at(f, x, y, z);
        if (!(std::abs(value - expected) <= tolerance * std::max(1.0, std::abs(expected))))
            FAIL_CHECK(name << " at " << x << " " << y << " " << z << ": " << value << ", not " << expected);
    }
    CHECK(count >= 20);
    CHECK(s.warnings.empty());
}

Expression mixed(const Items& t) { return t[0] + 10.0 * t[1] + 100.0 * t[2]; }

}  // namespace

TEST_CASE("one model of each group agrees with the old library") {
    compare("hfSuperell", [](Sketch& s) {
        Items c = s.list({0.3, -0.2, 0.5});
        return s.call("hfSuperell", {s.x, c, 1.0, 2.0, 1.5, 0.4, 0.7});
    });
    compare("hfMetaball", [](Sketch& s) {
        Items px = s.list({0, 1}), py = s.list({0, 0.5}), pz = s.list({0, -0.5}), u = s.list({1.2, 0.8}),
              v = s.list({1.5, 2.5});
        return s.call("hfMetaball", {s.x, px, py, pz, u, v, 0.1});
    });
    compare("hfConvTriangle", [](Sketch& s) {
        Items v = s.list({0, 0, 0, 2, 0.3, 0, 0.5, 1.5, 0.4, 1, 0, 0, 0, 1, 0, 0, 0, 1}),
              w = s.list({0.8, 1.3});
        return s.call("hfConvTriangle", {s.x, v, w, 0.2});
    });
    for (const int theta : {60, 200, 360})
        compare(
            "hfConvArc_" + std::to_string(theta),
            [=](Sketch& s) {
                Items center = s.list({0.3, -0.2, 0.5}), r = s.list({1.5}), th = s.list({double(theta)}),
                      axis = s.list({0.2, 1, 0.4}), angle = s.list({35}), w = s.list({0.9});
                return s.call("hfConvArc", {s.x, center, r, th, axis, angle, w, 0.2});
            },
            5e-6);
    compare("hfConvLineR_0p4", [](Sketch& s) {
        Items b = s.list({0, 0, 0, 1, 1, 1}), e = s.list({1, 0.5, -0.5, -1, 0, 1});
        return s.call("hfConvLineR", {s.x, b, e, 0.4});
    });
    compare("hfBezierVolume", [](Sketch& s) {
        Items box = s.list({-2, -1.5, -1, 2, 1.5, 1}),
              w = s.list({1, -1, 0.5, 2, -0.3, 1, 1, 2, -2, 0.7, 0.1, 0.2});
        return s.call("hfBezierVolume", {s.x, 2, 3, 2, box, w});
    });
    compare("hfSpaceMapCubic", [](Sketch& s) {
        Items source = s.list({0, 0, 0, 1, 1, 1}), target = s.list({0.5, 0.2, 0, 1, 1.5, 0.5}),
              b = s.list({2, 2, 2, 1, 3, 2}), t = s.x;
        s.call("hfSpaceMapCubic", {t, source, target, b});
        return mixed(t);
    });
    compare("hfBlendUni", [](Sketch& s) { return s.call("hfBlendUni", {s.x[0], s.x[1], 1.1, 0.7, 1.3}); });
    compare("hfDInt", [](Sketch& s) { return s.call("hfDInt", {s.x[0], s.x[1], 0.8, 0.3}); });
    compare(
        "hfDEllipsoid",
        [](Sketch& s) {
            Items c = s.list({0.3, -0.2, 0.5});
            return s.call("hfDEllipsoid", {s.x, c, 1.0, 2.0, 1.5});
        },
        5e-6);
    compare("hfNoiseG", [](Sketch& s) { return s.call("hfNoiseG", {s.x, 2.5, 0.7, 1.4}); });
    compare("hfA_Crackles", [](Sketch& s) {
        Items o = s.list({0, 0, 0}), rows = s.list({1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0.5}),
              map = s.list({0, 0.3, 0.6, 1});
        s.call("hfA_Crackles", {s.x, o, 0.8, rows, map});
        return mixed(o);
    });
    compare("hfA_Spline", [](Sketch& s) {
        Items o = s.list({0, 0, 0}), list = s.list({1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0.5, 1, 0.2, 0.1});
        s.call("hfA_Spline", {o, list, s.x[0], -1.0, 2.0});
        return mixed(o);
    });
}
