// Path data of SVG: every command against its points, written out; arcs against the circle and the ellipse;
// transforms against their matrices; what is refused, and where.
#include <doctest/doctest.h>

#include <cmath>

#include "frep/io/svg_data.h"

using namespace frep;
using namespace frep::reading;
using doctest::Approx;

namespace {

std::vector<CurveContour> path(std::string_view data) {
    CurveWriter out;
    const auto error = draw_path(data, out);
    if (error) FAIL_CHECK(std::string(data), ": ", error->message);
    return out.take();
}

/// "x,y x,y ..." of the corners of straight contours, contours apart by " | ".
std::string corners(std::string_view data) {
    std::string text;
    for (const CurveContour& contour : path(data)) {
        if (!text.empty()) text += " | ";
        const auto add = [&text](Vec2 p) {
            char buffer[64];
            std::snprintf(buffer, sizeof buffer, "%g,%g", p.x, p.y);
            text += buffer;
        };
        add(contour.start);
        for (const Segment& segment : contour.segments) {
            CHECK(segment.is_line);
            text += ' ';
            add(segment.to);
        }
    }
    return text;
}

/// The point of a cubic at t, by de Casteljau.
Vec2 on_cubic(Vec2 a, const Segment& s, double t) {
    const auto mix = [t](Vec2 p, Vec2 q) { return p * (1 - t) + q * t; };
    const Vec2 ab = mix(a, s.c1), bc = mix(s.c1, s.c2), cd = mix(s.c2, s.to);
    return mix(mix(ab, bc), mix(bc, cd));
}

void check_point(Vec2 p, double x, double y) {
    CHECK(p.x == Approx(x).epsilon(1e-12));
    CHECK(p.y == Approx(y).epsilon(1e-12));
}

std::size_t error_offset(std::string_view data) {
    CurveWriter out;
    const auto error = draw_path(data, out);
    if (!error) return 9999;
    CHECK(!error->message.empty());
    return error->offset;
}

}  // namespace

TEST_CASE("straight commands, absolute and relative") {
    CHECK(corners("M1 2L3 4") == "1,2 3,4");
    CHECK(corners("m1 2l3 4") == "1,2 4,6");
    CHECK(corners("M1 2H5V7h-1v-2") == "1,2 5,2 5,7 4,7 4,5");
    CHECK(corners("M1 2H5 6 7") == "1,2 5,2 6,2 7,2");
    CHECK(corners("M0 0 1 0 1 1z") == "0,0 1,0 1,1 0,0");
    CHECK(corners("m1 1 1 0 0 1z") == "1,1 2,1 2,2 1,1");
    CHECK(corners("M0 0L1 0L1 1Zm5 5l1 0") == "0,0 1,0 1,1 0,0 | 5,5 6,5");
    CHECK(corners("M2 3l1 0l0 1zl-1 -1") == "2,3 3,3 3,4 2,3 | 2,3 1,2");  // goes on from the start
    CHECK(corners("M0 0M1 1L2 2") == "1,1 2,2");                           // a move alone is nothing
}

TEST_CASE("numbers may stand as close as the grammar allows") {
    CHECK(corners("M.5.25L-1-2L1e1-2E-1") == "0.5,0.25 -1,-2 10,-0.2");
    CHECK(corners(" \tM 1 , 2\r\n,3,4 ") == "1,2 3,4");
    CHECK(corners("M+1+2 5.,6.") == "1,2 5,6");
    const auto close = path("M0 0a1 1 0 011 1"), wide = path("M0 0 a 1 1 0 0 1 1 1");
    REQUIRE(close.size() == 1);
    CHECK(close[0].segments.size() == wide[0].segments.size());
    check_point(close[0].segments.back().to, 1, 1);
}

TEST_CASE("cubics and quadratics with their smooth forms") {
    auto c = path("M0 0C1 2 3 4 5 6s3 3 4 0");
    REQUIRE(c[0].segments.size() == 2);
    check_point(c[0].segments[0].c1, 1, 2);
    check_point(c[0].segments[0].c2, 3, 4);
    check_point(c[0].segments[0].to, 5, 6);
    check_point(c[0].segments[1].c1, 7, 8);  // 2 (5,6) - (3,4)
    check_point(c[0].segments[1].c2, 8, 9);
    check_point(c[0].segments[1].to, 9, 6);
    c = path("M0 0S1 1 2 0");  // without a cubic before, the first handle is the present point
    check_point(c[0].segments[0].c1, 0, 0);
    c = path("m1 1c1 0 2 1 2 2 0 1 1 2 2 2");
    check_point(c[0].segments[1].c1, 3, 4);
    check_point(c[0].segments[1].to, 5, 5);

    // (1-t)^2 a + 2 (1-t) t b + t^2 c
    c = path("M0 0Q2 4 6 0t4 2T20 0");
    const Vec2 ends[4] = {{0, 0}, {6, 0}, {10, 2}, {20, 0}}, handles[3] = {{2, 4}, {10, -4}, {10, 8}};
    for (std::size_t i = 0; i < 3; ++i)
        for (const double t : {0.25, 0.5, 0.8}) {
            const double r = 1 - t;
            const Vec2 want = ends[i] * (r * r) + handles[i] * (2 * r * t) + ends[i + 1] * (t * t);
            check_point(on_cubic(ends[i], c[0].segments[i], t), want.x, want.y);
        }
    c = path("M0 0T4 4");
    check_point(on_cubic({0, 0}, c[0].segments[0], 0.5), 1,
                1);  // handle at the start: (0, 0), (0, 0), (4, 4)
}

TEST_CASE("arcs lie on their circle or ellipse") {
    struct Case {
        const char* data;
        Vec2 centre;
        double rx, ry, turn, sweep;  ///< degrees
    };
    // by the four choices of flags from (1, 0) to (0, 1), radius 1: centres (0, 0) and (1, 1)
    for (const Case& c :
         {Case{"M1 0A1 1 0 0 1 0 1", {0, 0}, 1, 1, 0, 90}, Case{"M1 0A1 1 0 1 0 0 1", {0, 0}, 1, 1, 0, -270},
          Case{"M1 0A1 1 0 0 0 0 1", {1, 1}, 1, 1, 0, -90}, Case{"M1 0A1 1 0 1 1 0 1", {1, 1}, 1, 1, 0, 270},
          Case{"M3 0a.5 .5 0 0 0 -6 0", {0, 0}, 3, 3, 0, -180},  // radii that are too small grow
          Case{"M0 4A2 4 0 0 1 0 -4", {0, 0}, 2, 4, 0, 180},
          Case{"M0 2A-2 4 90 0 1 0 -2", {0, 0}, 2, 4, 90, 180}}) {
        CAPTURE(c.data);
        const auto contours = path(c.data);
        Vec2 at = contours[0].start;
        double swept = 0;
        const double turn = c.turn * std::acos(-1.0) / 180;
        const auto unit = [&](Vec2 p) -> Vec2 {
            const Vec2 q = p - c.centre;
            return {(q.x * std::cos(turn) + q.y * std::sin(turn)) / c.rx,
                    (q.y * std::cos(turn) - q.x * std::sin(turn)) / c.ry};
        };
        for (const Segment& s : contours[0].segments) {
            for (int i = 0; i <= 20; ++i) {
                const Vec2 p = unit(on_cubic(at, s, i / 20.0));
                CHECK(std::hypot(p.x, p.y) == Approx(1).epsilon(1e-7));
            }
            const Vec2 a = unit(at), b = unit(s.to);
            swept += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
            at = s.to;
        }
        CHECK(swept * 180 / std::acos(-1.0) == Approx(c.sweep).epsilon(1e-9));
    }
    CHECK(corners("M0 0A0 5 0 0 1 3 4") == "0,0 3,4");  // a radius of 0 is a line
    CHECK(corners("M2 2A1 1 0 0 1 2 2L3 3") == "2,2 3,3");
}

TEST_CASE("what path data may not hold, and where") {
    CHECK(error_offset("L1 2") == 0);
    CHECK(error_offset("1 2") == 0);
    CHECK(error_offset("M1 2 X") == 5);
    CHECK(error_offset("M1") == 2);
    CHECK(error_offset("M1 2L3") == 6);
    CHECK(error_offset("M1 2L3 x") == 7);
    CHECK(error_offset("M0 0A1 1 0 2 0 1 1") == 11);
    CHECK(error_offset("M0 0C1 1 2 2 3") == 14);
    CHECK(error_offset("M0 0H") == 5);
    CHECK(error_offset("M0 0L1e400 1") == 5);
    CHECK(error_offset("M0 0Linf 1") == 5);
    CHECK(error_offset("M0 0,,1 1") == 5);
    CHECK(path("").empty());
}

TEST_CASE("transforms") {
    const auto map = [](std::string_view text) {
        Affine a;
        const auto error = parse_transform(text, a);
        if (error) FAIL_CHECK(error->message);
        return a;
    };
    const Vec2 p{3, 5};
    check_point(map("")(p), 3, 5);
    check_point(map("matrix(1 2 3 4 5 6)")(p), 3 + 15 + 5, 6 + 20 + 6);
    check_point(map("translate(10)")(p), 13, 5);
    check_point(map("translate(10,-1)")(p), 13, 4);
    check_point(map("scale(2)")(p), 6, 10);
    check_point(map("scale(2 -1)")(p), 6, -5);
    check_point(map("rotate(90)")(p), -5, 3);
    check_point(map("rotate(90 3 4)")(p), 2, 4);
    check_point(map("skewX(45)")(p), 8, 5);
    check_point(map("skewY(45)")(p), 3, 8);
    check_point(map(" translate(1 0) , scale(2)rotate(90) ")(p), 1 - 10, 6);  // the last one first
    Affine out;
    for (const char* bad : {"turn(3)", "scale()", "translate(1 2 3)", "rotate(1 2)", "scale(1", "scale 1",
                            "matrix(1 2 3 4 5 6 7)", "scale(1)x", "scale(a)"}) {
        CAPTURE(bad);
        CHECK(parse_transform(bad, out).has_value());
    }
}

TEST_CASE("lengths") {
    CHECK(parse_length("12.5mm")->number == 12.5);
    CHECK(parse_length(" 7 ")->unit.empty());
    CHECK(parse_length("2em")->unit == "em");
    CHECK(parse_length("50%")->unit == "%");
    CHECK(!parse_length("mm"));
    CHECK(*millimetres("in") == 25.4);
    CHECK(*millimetres("pt") * 72 == Approx(25.4));
    CHECK(*millimetres("px") * 96 == Approx(25.4));
    CHECK(!millimetres("furlong"));
}
