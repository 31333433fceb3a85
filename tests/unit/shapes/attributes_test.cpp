// Attribute functions: quirks of the old library and the correct functions beside them.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

TEST_CASE("hfA_Cerp is hfA_Lerp; hfA_CubicMix is cubic") {
    Sketch s;
    Items a = s.list({0}), b = s.list({1}), lerp = s.list({9}), cerp = lerp, cubic = lerp;
    const Expression t = s.call("hfA_Lerp", {lerp, a, b, s.x[0], 1.0, 3.0});
    s.call("hfA_Cerp", {cerp, a, b, s.x[0], 1.0, 3.0});
    s.call("hfA_CubicMix", {cubic, a, b, s.x[0], 1.0, 3.0});
    CHECK(at(t, 4, 0, 0) == 1.5);
    CHECK(at(lerp[0], 1.5, 0, 0) == 0.25);
    CHECK(at(lerp[0], 4, 0, 0) == 1);
    CHECK(lerp[0] == cerp[0]);
    CHECK(at(cubic[0], 1.5, 0, 0) == Approx(0.15625));
}

TEST_CASE("steps and floors") {
    Sketch s;
    CHECK(at(s.call("hfA_Floor", {s.x[0]}), -1.5, 0, 0) == -1);
    CHECK(at(s.call("hfA_FloorDown", {s.x[0]}), -1.5, 0, 0) == -2);
    CHECK(at(s.call("hfA_Modulo", {s.x[0], 0.7}), -0.1, 0, 0) == Approx(0.6));
    CHECK(at(s.call("hfA_Pulse", {s.x[0], 2.0, 1.0}), 1.5, 0, 0) == 1);
    CHECK(at(s.call("hfA_PulseBetween", {s.x[0], 1.0, 2.0}), 1.5, 0, 0) == 1);
    CHECK(at(s.call("hfA_Step", {s.x[0], 1.0}), 1, 0, 0) == 1);
    CHECK(at(s.call("hfA_Step", {s.x[0], 1.0}), 0.9, 0, 0) == 0);
    CHECK(at(s.call("hfA_SmoothStep", {s.x[0], 0.0, 2.0}), 0.5, 0, 0) == Approx(0.15625));
    CHECK(at(s.call("hfA_SmoothStep", {7, 8, 9, s.x[0], 0.0, 2.0}), 0.5, 0, 0) == Approx(0.15625));
    CHECK(at(s.call("hfA_SmoothStep", {s.x[0], 1.0, 1.0}), 1, 0, 0) == 1);
    CHECK(std::isnan(at(s.call("hfA_Step", {s.x[0], 1.0}), std::nan(""), 0, 0)));
}

TEST_CASE("look-up below the map: last row of old, first row of the new functions") {
    Sketch s;
    Items rows = s.list({1, 10, 2, 20, 3, 30}), map = s.list({0, 1, 2}), o = s.list({0, 0}), p = o, q = o,
          r = o;
    s.call("hfA_LookUpTable", {s.x[0], o, rows, map});
    s.call("hfA_LookUp", {s.x[0], p, rows, map});
    s.call("hfA_SmoothLookUpTable", {s.x[0], q, rows, map});
    s.call("hfA_SmoothLookUp", {s.x[0], r, rows, map});
    CHECK(at(o[1], -1, 0, 0) == 30);
    CHECK(at(p[1], -1, 0, 0) == 10);
    CHECK(at(q[0], -1, 0, 0) == 3);
    CHECK(at(r[0], -1, 0, 0) == 1);
    CHECK(at(o[1], 1.5, 0, 0) == 20);
    CHECK(at(q[1], 1.5, 0, 0) == 25);
    CHECK(at(o[1], 2, 0, 0) == 30);
}

TEST_CASE("the overwritten item of circles and crackles is in a copy") {
    Sketch s;
    Items rows = s.list({0.1, 0.2, 0.3, 0.4}), map = s.list({0, 0.5}), o = s.list({9, 9}), p = o;
    s.call("hfA_Circles", {s.x, o, rows, map});
    s.call("hfA_Rings", {s.x, p, rows, map});
    CHECK(at(o[0], 0.25, 0, 0) == 0.1);
    CHECK(at(o[0], 0.75, 0, 0) == 9);
    CHECK(rows[2] == s.number(0.3));
    Items three = s.list({0.1, 0.2, 0.3}), numbers = s.list({0, 0.4, 0.8}), c = s.list({0}), d = c;
    Items four = s.list({0.1, 0.2, 0.3, 0.4}), two = s.list({0, 0.4}), e = s.list({0, 0}), f = e;
    s.call("hfA_Circles", {s.x, e, four, two});
    s.call("hfA_Rings", {s.x, f, four, two});
    CHECK(at(e[0], 0.2, 0, 0) == at(f[0], 0.2, 0, 0));
    s.call("hfA_Crackles", {s.x, c, 0.8, three, numbers});
    s.call("hfA_Cracks", {s.x, d, 0.8, three, numbers});
    CHECK(at(c[0], 0, 0, 0) == at(d[0], 0, 0, 0));
    CHECK(s.warnings.empty());
}

TEST_CASE("union attributes, colours of solids") {
    Sketch s;
    Items first = s.list({1, 2}), second = s.list({3, 1}), o = s.list({7, 8});
    s.call("hfA_Union", {s.x[0], s.x[1], o, first, second, 2.0});
    CHECK(at(o[0], 1, 1, 0) == 4);
    CHECK(at(o[0], 1, -1, 0) == 1);
    CHECK(at(o[0], -1, 1, 0) == 3);
    CHECK(at(o[0], -1, -1, 0) == 7);
    o = s.list({7, 8});
    s.call("hfA_Union", {s.x[0], s.x[1], o, first, second, s.x[2]});  // the mode may be a field
    CHECK(at(o[1], 1, 1, 3) == 1);
    CHECK(at(o[1], 1, 1, 4) == 2);
    CHECK(at(o[1], 1, 1, 9) == 8);
    Items color = s.list({0, 0, 0});
    s.call("hfA_SetColor", {s.x[0], color, 0.2, 0.4, 0.6});
    CHECK(at(color[2], 0, 0, 0) == 0.6);
    CHECK(at(color[2], -1, 0, 0) == 0);
}

TEST_CASE("colour models") {
    Sketch s;
    Items rgb = {s.x[0], s.x[1], s.x[2]}, hsv = s.list({0, 0, 0}), wrapped = hsv, back = hsv;
    s.call("hfA_RGBToHSV", {rgb, hsv});
    s.call("hfA_RGBToHue360", {rgb, wrapped});
    s.call("hfA_HSVToRGB", {hsv, back});
    CHECK(at(hsv[0], 1, 0, 0.5) == Approx(-30));
    CHECK(at(wrapped[0], 1, 0, 0.5) == Approx(330));
    CHECK(at(hsv[0], 0.2, 0.2, 0.2) == 0);
    CHECK(at(hsv[1], 0, 0, 0) == 0);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 1000; ++i) {
        const double p[3] = {uniform(random), uniform(random), uniform(random)};
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(at(back[k], p[0], p[1], p[2]) == Approx(p[k]).epsilon(1e-12));
    }
}

TEST_CASE("a spline passes its rows and ends well") {
    Sketch s;
    Items list = s.list({5, 1, 2, 4, 3}), o = s.list({0});
    s.call("hfA_Spline", {o, list, s.x[0], 0.0, 2.0});
    CHECK(at(o[0], -0.1, 0, 0) == 5);
    CHECK(at(o[0], 0, 0, 0) == 1);
    CHECK(at(o[0], 1, 0, 0) == Approx(2));
    CHECK(at(o[0], 2, 0, 0) == Approx(4));
    CHECK(at(o[0], 2.1, 0, 0) == 3);
}
