// Enclosures: over random boxes every sampled value of every blend and block op lies in the interval, the
// interval is not much wider than the samples, and lanes and duals give the bits of double.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;

namespace {

struct Case {
    std::string name;
    std::function<Expression(Sketch&)> make;
};

Expression blend_case(Sketch& s, const char* name, bool bounded) {
    const Expression f1 = 1.0 - hypot(s.x[0], s.x[1]), f2 = 0.7 - hypot(s.x[1], s.x[2]);
    const Expression f3 = 1.0 - square(s.x[0] - 0.5) - square(s.x[2]);
    if (bounded) return s.call(name, {f1, f2, f3, 0.4, 0.5, 0.6, 0.9});
    return s.call(name, {f1, f2, 0.4, 0.5, 0.6});
}
Expression op3(Sketch& s, Op op, std::vector<double> data) {
    std::vector<NodeId> items, lead;
    for (const double d : data) items.push_back(s.graph.constant(d));
    for (const Expression& e : s.x) lead.push_back(e.id());
    return {s.graph, s.graph.make_block(op, lead, items)};
}
std::vector<double> net(double l, double m, double n, double extra) {
    std::vector<double> data = {l, m, n};
    for (int i = 0; i < l * m * n; ++i) data.push_back(std::cos(1.7 * i + extra));
    return data;
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"blend_uni", [](Sketch& s) { return blend_case(s, "hfBlendUni", false); }},
        {"blend_int", [](Sketch& s) { return blend_case(s, "hfBlendInt", false); }},
        {"point_uni", [](Sketch& s) { return blend_case(s, "hfPointBlendUni", false); }},
        {"point_int", [](Sketch& s) { return blend_case(s, "hfPointBlendInt", false); }},
        {"bounded_uni", [](Sketch& s) { return blend_case(s, "hfBoundedBlendUni", true); }},
        {"bounded_int", [](Sketch& s) { return blend_case(s, "hfBoundedBlendInt", true); }},
        {"bounded, all fields",
         [](Sketch& s) {
             return s.call("hfBoundedBlendUni",
                           {s.x[0], s.x[1], s.x[2], s.x[0] - 0.5, s.x[1] + 1.0, s.x[2], 0.7});
         }},
        {"sardf_int",
         [](Sketch& s) {
             return s.call("hfDInt", {s.x[0], s.x[1], 0.8, 0.3});
         }},
        {"sardf_int, radius a field",
         [](Sketch& s) {
             return s.call("hfDInt", {s.x[0], s.x[1], s.x[2], 0.3});
         }},
        {"sardf_blend",
         [](Sketch& s) {
             return s.call("hfDBlendInt", {s.x[0], s.x[1], s.x[2]});
         }},
        {"ellipsoid",
         [](Sketch& s) {
             Items c = s.list({0.1, 0, 0});
             return s.call("hfDEllipsoid", {s.x, c, 1.0, 2.0, 0.4});
         }},
        {"sawtooth",
         [](Sketch& s) {
             return s.call("hfSawtooth", {s.x[0], 6.0, 1.5, s.x[1]});
         }},
        {"lattice_noise", [](Sketch& s) { return s.call("hfA_NoiseP", {s.x}); }},
        {"turbulence",
         [](Sketch& s) {
             return s.call("hfA_Turbulence", {s.x, 5.0});
         }},
        {"blobby",
         [](Sketch& s) {
             return op3(s, Op::blobby, {0, 0, 0, 1.2, 1.5, 1, 0.5, -0.5, 0.8, -2.5});
         }},
        {"metaball",
         [](Sketch& s) {
             return op3(s, Op::metaball, {0, 0, 0, 1.2, 1.5, 1, 0.5, -0.5, 0.8, 2.5});
         }},
        {"soft",
         [](Sketch& s) {
             return op3(s, Op::soft, {0, 0, 0, 1.5, 1, 0.5, -0.5, 2.5});
         }},
        {"fitted_blob",
         [](Sketch& s) {
             return op3(s, Op::fitted_blob, {0, 0, 0, 1.5, 1, 1, 0.5, -0.5, 2.5, 0.3});
         }},
        {"radial_cubic",
         [](Sketch& s) {
             std::vector<NodeId> data, lead;
             for (const double d :
                  {0.3, -0.4, 0.1, 0.2, -1.0, 0.0, 0.0, 0.0, 0.0, 1.5, 1.0, 0.5, -0.5, 1.0, -2.0})
                 data.push_back(s.graph.constant(d));
             for (const Expression& e : s.x) lead.push_back(e.id());
             lead.push_back((s.x[0] - s.x[1]).id());
             return Expression(s.graph, s.graph.make_block(Op::radial_cubic, lead, data));
         }},
        {"conv_point",
         [](Sketch& s) {
             return op3(s, Op::conv_point, {0, 0, 0, 1.5, 1, 0.5, -0.5, 2.5});
         }},
        {"conv_line",
         [](Sketch& s) {
             return op3(s, Op::conv_line, {0, 0, 0, 1.5, 1, 0.5, 1.2});
         }},
        {"conv_triangle",
         [](Sketch& s) {
             return op3(s, Op::conv_triangle, {0, 0, 0, 2, 0.3, 0, 0.5, 1.5, 0.4, 0.8, 1});
         }},
        {"conv_arc",
         [](Sketch& s) {
             return op3(s, Op::conv_arc, {0, 0, 0, 0, 1, 0, 0, 0, 1, 1.2, 4, 0.9, 1});
         }},
        {"conv_line, ends that move",
         [](Sketch& s) {
             Items begin = {s.x[1], s.number(0), s.number(0)}, end = s.list({1, 2, 0}), w = s.list({1});
             return s.call("hfConvLine", {s.x, begin, end, w, 0.1});
         }},
        {"bezier_volume", [](Sketch& s) { return op3(s, Op::bezier_volume, net(3, 4, 2, 0)); }},
        {"bspline_volume", [](Sketch& s) { return op3(s, Op::bspline_volume, net(6, 5, 4, 1)); }},
        {"voxels", [](Sketch& s) { return op3(s, Op::voxels, net(4, 3, 3, 2)); }},
    };
    return all;
}

bool same(double a, double b) { return math::to_bits(a) == math::to_bits(b) || (a != a && b != b); }

}  // namespace

TEST_CASE("enclosures hold and are tight") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(-2.5, 2.5), unit(-1, 1);
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        Sketch s;
        const Expression f = c.make(s);
        int wide = 0, boxes = 0, undefined = 0;
        for (int i = 0; i < 300; ++i) {
            const double h = i % 2 ? 1e-3 : std::exp(3 * unit(random) - 2.5);
            double m[3];
            Box box;
            math::Interval* const side[3] = {&box.x, &box.y, &box.z};
            for (std::size_t k = 0; k < 3; ++k) {
                m[k] = i % 9 ? place(random) : std::round(place(random));
                *side[k] = {m[k] - h, m[k] + h};
            }
            const math::Interval range = range_over(f, box);
            undefined += range.maybe_undefined;
            double low = math::infinity, high = -math::infinity;
            for (int j = 0; j < 60; ++j) {
                double p[3];
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = j < 8 ? ((j >> k) & 1 ? side[k]->hi : side[k]->lo)
                                 : std::min(std::max(m[k] + h * unit(random), side[k]->lo), side[k]->hi);
                const double v = at(f, p[0], p[1], p[2]);
                low = std::min(low, v);
                high = std::max(high, v);
                if (v != v ? !range.maybe_undefined : !range.contains(v))
                    FAIL_CHECK(v << " outside " << range.lo << " " << range.hi << " at " << p[0] << " "
                                 << p[1] << " " << p[2]);
            }
            if (i % 2 == 0) continue;
            ++boxes;
            wide += range.width() > 100 * (high - low) + 1e-13;
        }
        CHECK(wide <= boxes / 10);
        CHECK(undefined == 0);
    }
}

TEST_CASE("lanes and duals give the bits of double") {
    using math::Lanes;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> place(-2.5, 2.5);
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 5e-8, 1e-200, 1e200, math::infinity, math::quiet_nan, 2.5};
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        Sketch s;
        const Expression f = c.make(s);
        for (int i = 0; i < 300; ++i) {
            Lanes p[3];
            std::vector<math::Dual<Lanes>> dual(3);
            for (int k = 0; k < 3; ++k) {
                for (int lane = 0; lane < Lanes::size; ++lane)
                    p[k].set(lane, random() % 6 == 0 ? odd[random() % 10] : place(random));
                dual[static_cast<std::size_t>(k)] = math::Dual<Lanes>::variable(p[k], k);
            }
            const Lanes values = evaluate<Lanes>(f, {p[0], p[1], p[2]});
            const math::Dual<Lanes> wide = evaluate<math::Dual<Lanes>>(f, dual);
            for (int lane = 0; lane < Lanes::size; ++lane) {
                const double x = p[0][lane], y = p[1][lane], z = p[2][lane], v = at(f, x, y, z);
                const auto d = gradient_at(f, x, y, z);
                bool good = same(v, values[lane]) && same(v, wide.value[lane]) && same(v, d.value);
                for (std::size_t k = 0; k < 3; ++k) {
                    good = good && same(d.d[k], wide.d[k][lane]);
                    good = good && !(std::abs(v) < math::infinity && !(std::abs(d.d[k]) < math::infinity));
                }
                if (!good)
                    FAIL_CHECK("at " << x << " " << y << " " << z << ": " << v << " " << values[lane] << " "
                                     << wide.value[lane] << " " << d.value << " d " << d.d[0] << " " << d.d[1]
                                     << " " << d.d[2] << " / " << wide.d[0][lane]);
            }
        }
    }
}
