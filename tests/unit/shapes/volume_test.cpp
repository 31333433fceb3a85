// hfVolume: values, places and the box of a grid from a file; what is reported.
#include <doctest/doctest.h>

#include <cmath>

#include "unit/shapes/sketch.h"

using namespace frep;
using namespace frep::test;
using doctest::Approx;

namespace {

struct Files : Sketch {
    Files() {
        build.read_file = [](std::string_view name) -> Result<std::string> {
            const std::string head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 2\nencoding: raw\n";
            const std::string data("\x00\x0a\x14\x1e\x28\x32\x3c\x46\x50\x5a\x64\x6e",
                                   12);  // 0, 10, ..., 110
            if (name == "a.nrrd") return head + "spacings: 2 1 4\nspace origin: (10,0,-1)\n\n" + data;
            if (name == "scans/b.nhdr")
                return head + "space directions: (0,2,0) (1,1,0) (0,0,-1)\ndata file: b.raw\n";
            if (name == "scans/b.raw") return data;
            if (name == "bad.nrrd") return head + "\n" + data.substr(1);
            return Error{ErrorKind::io, "no such file"};
        };
        build.refuse = [this](const std::string& message) { errors.push_back(message); };
    }
    std::vector<std::string> errors;
};

}  // namespace

TEST_CASE("hfVolume: trilinear inside, closed by its box") {
    Files s;
    const Expression f = s.call("hfVolume", {s.x, "a.nrrd", -1000.0});
    CHECK(s.errors.empty());
    // the value is 10 i + 20 j + 60 k; 1000 more is above the distance to the box
    CHECK(at(f, 11, 1, 1) == Approx(1));
    CHECK(at(f, 10.5, 1, 1) == Approx(0.5));
    CHECK(at(f, 11, 1, 2.75) == Approx(0.25));
    CHECK(at(f, 9, 1, 1) == Approx(-1));
    CHECK(at(f, 11, 5, 1) == Approx(-3));
    const Expression g = s.call("hfVolume", {s.x, "a.nrrd", 55.0});
    // (i, j, k) = (0.5, 1, 0.5): 5 + 20 + 30 = 55
    CHECK(at(g, 11, 1, 1) == Approx(0).scale(1));
    CHECK(at(g, 11, 0.9, 1) == Approx(-2));
    CHECK(at(g, 10.9, 1, 1) == Approx(-0.5));
    CHECK(at(g, 11, 1.01, 1) == Approx(0.2));
    CHECK(at(g, 20, 1, 1) < -7);
}

TEST_CASE("hfVolume: directions that turn and shear, data beside the header") {
    Files s;
    const Expression g = s.call("hfVolume", {s.x, "scans/b.nhdr", 42.0});
    CHECK(s.errors.empty());
    // (i, j, k) = (0.2, 1, 0.25) stands at (0, 2, 0) i + (1, 1, 0) j + (0, 0, -1) k; value 2 + 20 + 15
    CHECK(at(g, 1, 1.4, -0.25) == Approx(-5));
    const Expression f = s.call("hfVolume", {s.x, "scans/b.nhdr", -1000.0});
    CHECK(at(f, 1, 1.4, -0.25) == Approx(0.25));               // the face k = 0
    CHECK(at(f, 1, 1.2, -0.5) == Approx(0.2 / std::sqrt(2)));  // the face i = 0, slanted by 45 degrees
    CHECK(at(f, 2.1, 2.5, -0.5) == Approx(-0.1));
}

TEST_CASE("hfVolume: enclosures and refusals") {
    Files s;
    const Expression g = s.call("hfVolume", {s.x, "a.nrrd", 55.0});
    for (const double h : {0.01, 0.5, 3.0}) {
        const auto range = range_over(g, {{11 - h, 11 + h}, {1 - h, 1 + h}, {1 - h, 1 + h}});
        for (int i = 0; i < 27; ++i)
            CHECK(range.contains(at(g, 11 + h * (i % 3 - 1), 1 + h * (i / 3 % 3 - 1), 1 + h * (i / 9 - 1))));
        CHECK(range.hi <= 55.001);
    }
    CHECK(at(s.call("hfVolume", {s.x, "bad.nrrd", 1.0}), 0, 0, 0) == shapes::error_value);
    REQUIRE(s.errors.size() == 1);
    CHECK(s.errors[0] == "bad.nrrd: the data have 11 of 12 samples");
    Items flat = {s.x[0], s.x[1]};
    CHECK(at(s.call("hfVolume", {flat, "a.nrrd", 1.0}), 0, 0, 0) == shapes::error_value);
    CHECK(s.warnings.size() == 1);
}
