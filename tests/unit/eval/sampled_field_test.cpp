// Tests of eval/sampled_field.h with an evaluator written for the test: coordinates mapped and frozen, the
// iso value, attributes set aside, intervals and gradients carried along.
#include "frep/eval/sampled_field.h"

#include <doctest/doctest.h>

#include <limits>

#include "frep/math/interval.h"

using namespace frep;

namespace {

/// F(c1, c2, c3, c4) = c1 + 10 c2 + 100 c3 + 1000 c4, undefined for c1 < 0; one attribute.
class LinearEvaluator final : public Evaluator {
  public:
    std::unique_ptr<Evaluator> clone() const override { return std::make_unique<LinearEvaluator>(); }
    int coordinates() const override { return 4; }
    int outputs() const override { return 2; }
    void values(std::span<const double* const> c, std::size_t count, std::span<double* const> out) override {
        REQUIRE((out.size() == 1 || out.size() == 2));
        for (std::size_t p = 0; p < count; ++p) {
            out[0][p] = c[0][p] < 0 ? std::numeric_limits<double>::quiet_NaN()
                                    : c[0][p] + 10 * c[1][p] + 100 * c[2][p] + 1000 * c[3][p];
            if (out.size() == 2) out[1][p] = 7;
        }
    }
    void gradients(std::span<const double* const> c, std::size_t count, double* out,
                   std::span<double* const> partials) override {
        std::vector<double> attribute(count);
        double* const both[] = {out, attribute.data()};
        values(c, count, both);
        double slope = 1;
        for (std::size_t i = 0; i < 4; ++i, slope *= 10) {
            for (std::size_t p = 0; p < count; ++p) partials[i][p] = slope;
        }
    }
    void intervals(std::span<const math::Interval* const> c, std::size_t count,
                   math::Interval* out) override {
        for (std::size_t b = 0; b < count; ++b) {
            const auto [lo, hi] = std::pair{c[0][b].lo, c[0][b].hi};
            if (hi < 0) {
                out[b] = math::Interval::empty();
                continue;
            }
            const double rest_lo = 10 * c[1][b].lo + 100 * c[2][b].lo + 1000 * c[3][b].lo;
            const double rest_hi = 10 * c[1][b].hi + 100 * c[2][b].hi + 1000 * c[3][b].hi;
            out[b] = {lo + rest_lo, hi + rest_hi, lo < 0};
        }
    }
};

std::unique_ptr<SampledField> mapped(const AxisMap& map, double iso = 0) {
    auto field = make_sampled_field(std::make_unique<LinearEvaluator>(), map, iso);
    REQUIRE(static_cast<bool>(field));
    return std::move(*field);
}

constexpr int frozen = -1;

}  // namespace

TEST_CASE("coordinates are mapped to axes or frozen, the iso value is taken off") {
    // --map x,0.5,z,y
    const AxisMap map{{{0}, {frozen, 0.5}, {2}, {1}}};
    CHECK(map.uses(1));
    const auto field = mapped(map, 3)->clone();
    const std::vector<double> x{1, -1}, y{2, 2}, z{4, 4};
    std::vector<double> out(2), gx(2), gy(2), gz(2);
    field->values({x, y, z}, out);
    CHECK(out[0] == 1 + 5 + 400 + 2000 - 3);
    CHECK(out[1] != out[1]);
    out = {0, 0};
    field->gradients({x, y, z}, out, {gx, gy, gz});
    CHECK(out[0] == 2403);
    CHECK(gx[0] == 1);
    CHECK(gy[0] == 1000);
    CHECK(gz[1] == 100);
}

TEST_CASE("an axis may feed several coordinates or none") {
    const AxisMap map{{{0}, {0}, {frozen, 0}, {0}}};
    CHECK_FALSE(map.uses(2));
    const auto field = mapped(map);
    const std::vector<double> x{2}, y{5}, z{5};
    std::vector<double> out(1), gx(1), gy(1), gz(1);
    field->gradients({x, y, z}, out, {gx, gy, gz});
    CHECK(out[0] == 2022);
    CHECK(gx[0] == 1011);
    CHECK(gy[0] == 0);
    CHECK(gz[0] == 0);
}

TEST_CASE("attributes, all or the first ones") {
    const auto field = mapped(AxisMap::standard(4));
    CHECK(field->attribute_count() == 1);
    const std::vector<double> x{1, 2}, y{0, 0}, z{0, 0};
    std::vector<double> first(2);
    const std::vector<std::span<double>> columns{first};
    field->attributes({x, y, z}, columns);
    CHECK(first[0] == 7);
    CHECK(first[1] == 7);
    field->attributes({x, y, z}, {});
}

TEST_CASE("signs over boxes") {
    const auto field = mapped(AxisMap::standard(4), 5);
    const std::vector<Box3> boxes{{{6, 0, 0}, {7, 1, 1}}, {{0, 0, 0}, {4, 0, 0}},  {{4, 0, 0}, {5, 0, 0}},
                                  {{5, 0, 0}, {6, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}}, {{-2, 0, 0}, {-1, 0, 0}}};
    std::vector<SignRange> ranges(boxes.size());
    field->ranges(boxes, ranges);
    const auto is = [&](std::size_t i, bool inside, bool outside, bool undefined) {
        return ranges[i].can_be_inside == inside && ranges[i].can_be_outside == outside &&
               ranges[i].can_be_undefined == undefined;
    };
    CHECK(is(0, true, false, false));
    CHECK(is(1, false, true, false));
    CHECK(is(2, true, true, false));
    CHECK(is(3, true, false, false));  // F = iso is inside
    CHECK(is(4, false, true, true));
    CHECK(is(5, false, false, true));
}

TEST_CASE("maps that do not fit are refused") {
    const auto refused = [](const AxisMap& map, double iso = 0) {
        const auto field = make_sampled_field(std::make_unique<LinearEvaluator>(), map, iso);
        return !field && field.error().kind == ErrorKind::invalid_argument;
    };
    CHECK(refused(AxisMap::standard(3)));
    CHECK(refused({{{0}, {1}, {3}, {2}}}));
    CHECK(refused({{{0}, {1}, {2}, {frozen, std::numeric_limits<double>::infinity()}}}));
    CHECK(refused(AxisMap::standard(4), std::numeric_limits<double>::quiet_NaN()));
    CHECK_FALSE(refused(AxisMap::standard(4)));
}
