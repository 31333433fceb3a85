// Tests of attributes and colors at the vertices (contour/contour.h): taken inside the surface, also at caps
// and walls; the same for any number of threads.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "frep/contour/contour.h"
#include "unit/contour/test_fields.h"

using namespace frep;
using test::FunctionField;
using test::generic_field;
using test::sphere_function;

namespace {

/// A field with attributes as the library's color functions write them: only where F >= 0.
class ColoredField final : public SampledField {
  public:
    ColoredField(FunctionField shape, std::size_t count) : shape_(std::move(shape)), count_(count) {}
    std::unique_ptr<SampledField> clone() const override { return std::make_unique<ColoredField>(*this); }
    void values(const PointSpans& p, std::span<double> out) override { shape_.values(p, out); }
    void gradients(const PointSpans& p, std::span<double> v, const GradientSpans& out) override {
        shape_.gradients(p, v, out);
    }
    void ranges(std::span<const Box3> boxes, std::span<SignRange> out) override { shape_.ranges(boxes, out); }
    std::size_t attribute_count() const override { return count_; }
    void attributes(const PointSpans& p, std::span<const std::span<double>> out) override {
        for (std::size_t i = 0; i < p.size(); ++i) {
            const bool inside = shape_(p.x[i], p.y[i], p.z[i]) >= 0;
            const double axes[3] = {p.x[i], p.y[i], p.z[i]};
            for (std::size_t k = 0; k < out.size(); ++k)
                out[k][i] = inside ? 0.5 + 0.5 * axes[k % 3] : test::undefined;
        }
    }

  private:
    FunctionField shape_;
    std::size_t count_;
};

ContourResult contoured(const SampledField& field, const ContourOptions& options, int threads = 1) {
    Job job;
    job.threads = threads;
    Result<ContourResult> result = contour_cells(field, options, job);
    REQUIRE(static_cast<bool>(result));
    REQUIRE(is_valid(result->mesh));
    return std::move(*result);
}

/// Every attribute is that of the vertex' place, up to the margin that keeps nodes off the samples.
void check_places(const ContourResult& r, double tolerance) {
    const std::vector<Vec3>& at = r.mesh.vertices;
    for (std::size_t v = 0; v < at.size(); ++v) {
        const double axes[3] = {at[v].x, at[v].y, at[v].z};
        for (std::size_t k = 0; k < r.attributes.size(); ++k) {
            REQUIRE(r.attributes[k].size() == at.size());
            REQUIRE(std::abs(r.attributes[k][v] - 0.5 - 0.5 * axes[k % 3]) < tolerance);
        }
    }
}

}  // namespace

TEST_CASE("attributes are taken at the vertices, a hair inside the surface") {
    const ColoredField ball(generic_field(sphere_function(0.9)), 3);
    const ContourResult r = contoured(ball, {.bounds = Box3::cube(1), .cells = 21, .attributes = 3});
    REQUIRE(r.attributes.size() == 3);
    REQUIRE(r.mesh.vertices.size() > 500);
    check_places(r, 1e-4);
    const std::vector<Color> colors = vertex_colors(r, {1, 0, 1});
    REQUIRE(colors.size() == r.mesh.vertices.size());
    for (std::size_t v = 0; v < colors.size(); ++v) REQUIRE(std::abs(colors[v].g - r.attributes[1][v]) == 0);
}

TEST_CASE("attributes at samples on the surface, at caps and walls") {
    // The cube's faces lie on samples, where F = 0; the cap's nodes are samples; the wall ends the domain.
    const auto cube = [](auto x, auto y, auto z) {
        using math::abs;
        using math::min;
        return min(min(0.5 - abs(x), 0.5 - abs(y)), 0.5 - abs(z));
    };
    check_places(contoured(ColoredField(generic_field(cube), 5),
                           {.bounds = Box3::cube(1), .cells = 8, .attributes = 3}),
                 1e-4);
    check_places(contoured(ColoredField(generic_field(sphere_function(0.9)), 3),
                           {.bounds = Box3::cube(0.7), .cells = 13, .cap = true, .attributes = 3}),
                 1e-4);
    const auto wall = [](auto x, auto y, auto z) {
        return sphere_function(0.9)(x, y, z) + 0.0 * math::sqrt(0.3 - x);
    };
    check_places(contoured(ColoredField(generic_field(wall), 3),
                           {.bounds = Box3::cube(1), .cells = 13, .attributes = 3}),
                 1e-4);
}

TEST_CASE("vertices in the middle of polygons take the mean of their neighbours") {
    // Noise gives polygons without a triangulation of their own, whose middles often lie outside.
    const int cells = 9;
    const FunctionField noise([=](double x, double y, double z) {
        const auto index = [=](double v) {
            return static_cast<std::uint64_t>(std::floor((v + 1) * 0.5 * cells + 0.5) + 100);
        };
        return test::noise(4, (index(z) * 1000 + index(y)) * 1000 + index(x));
    });
    const ContourResult r =
        contoured(ColoredField(noise, 3), {.bounds = Box3::cube(1), .cells = cells, .attributes = 3});
    check_places(r, 2.0 / cells);
    for (const std::vector<double>& column : r.attributes)
        for (const double v : column) REQUIRE(v == v);
}

TEST_CASE("fewer attributes than asked for, undefined ones, and values beyond 0 and 1") {
    const ColoredField two(generic_field(sphere_function(0.9)), 2);
    ContourResult r = contoured(two, {.bounds = Box3::cube(1), .cells = 5, .attributes = 3});
    CHECK(r.attributes.size() == 2);
    CHECK(vertex_colors(r, {}).empty());
    CHECK(contoured(two, {.bounds = Box3::cube(1), .cells = 5}).attributes.empty());
    r.attributes = {{0.25, test::undefined, 7}, {0.5, 0.5, -test::infinity}, {1, 1, -0.0}};
    const std::vector<Color> colors = vertex_colors(r, {0.1, 0.2, 0.3});
    CHECK(colors[0] == Color{0.25, 0.5, 1});
    CHECK(colors[1] == Color{0.1, 0.2, 0.3});
    CHECK(colors[2] == Color{1, 0, 0});
}

TEST_CASE("attributes are the same for every number of threads, and change no vertex") {
    const ColoredField ball(generic_field(sphere_function(0.9, 0.02)), 3);
    const ContourOptions options{.bounds = Box3::cube(0.85), .cells = 40, .cap = true, .attributes = 3};
    const ContourResult one = contoured(ball, options);
    for (const int threads : {2, 8}) {
        const ContourResult many = contoured(ball, options, threads);
        REQUIRE(many.attributes.size() == 3);
        for (std::size_t k = 0; k < 3; ++k) {
            REQUIRE(many.attributes[k].size() == one.attributes[k].size());
            CHECK(std::memcmp(many.attributes[k].data(), one.attributes[k].data(),
                              one.attributes[k].size() * sizeof(double)) == 0);
        }
    }
    ContourOptions plain = options;
    plain.attributes = 0;
    const ContourResult bare = contoured(ball, plain);
    CHECK(bare.mesh.vertices == one.mesh.vertices);
    CHECK(bare.mesh.triangles == one.mesh.triangles);
}

TEST_CASE("no triangle names a vertex twice, with the cap too") {
    // The cap makes one node of several edges at the box's edges (0.6) and corners (0.5).
    for (const double half : {0.7, 0.6, 0.5}) {
        CAPTURE(half);
        const ContourResult r = contoured(generic_field(sphere_function(0.9)),
                                          {.bounds = Box3::cube(half), .cells = 11, .cap = true});
        REQUIRE(r.mesh.triangles.size() > 100);
        for (const Triangle& t : r.mesh.triangles) REQUIRE((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
    }
}
