// Tests of trace/plane_levels.h and plane_colors.h: round numbers, labels, levels of samples, the color
// scale.
#include "frep/trace/plane_levels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "frep/trace/plane_colors.h"

using namespace frep;
using namespace frep::drawing;

namespace {

using List = std::vector<double>;
using Texts = std::vector<std::string>;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

List ramp(double low, double high, int count) {
    List out;
    for (int i = 0; i < count; ++i) out.push_back(low + (high - low) * i / (count - 1));
    return out;
}

}  // namespace

TEST_CASE("steps are the next 1, 2 or 5") {
    const auto size = [](double wish) { return round_step(wish).times(1); };
    CHECK(size(1) == 1);
    CHECK(size(1.01) == 2);
    CHECK(size(2) == 2);
    CHECK(size(2.5) == 5);
    CHECK(size(5.1) == 10);
    CHECK(size(0.03) == 0.05);
    CHECK(size(7e-301) == 1e-300);
    CHECK(size(3e300) == 5e300);
    CHECK(round_step(0.1).times(3) == 0.3);
}

TEST_CASE("ticks are correctly rounded decimals within the range") {
    CHECK(round_ticks(-0.31, 0.71, 10).values == List{-0.2, 0, 0.2, 0.4, 0.6});
    CHECK(round_ticks(0.1, 0.7, 6).values == List{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7});
    CHECK(round_ticks(1, 1, 5).values.empty());
    CHECK(round_ticks(2, 1, 5).values.empty());
    CHECK(round_ticks(0, inf, 5).values.empty());
    CHECK(round_ticks(undefined, 1, 5).values.empty());
    CHECK(round_ticks(1, 1 + 1e-15, 5).values.empty());
    for (int count = 1; count < 40; ++count) {
        const Ticks ticks = round_ticks(-123.4, 777.7, count);
        CHECK(ticks.values.size() <= static_cast<std::size_t>(count) + 1);
        for (const double v : ticks.values) CHECK((v >= -123.4 && v <= 777.7));
    }
}

TEST_CASE("labels of one scale have the same decimals, a true minus, and a common power of ten") {
    const std::string minus = "\xe2\x88\x92";
    CHECK(tick_labels(round_ticks(-0.5, 0.5, 5)).texts ==
          Texts{minus + "0.4", minus + "0.2", "0.0", "0.2", "0.4"});
    CHECK(tick_labels(round_ticks(-60, 20, 4)).texts ==
          Texts{minus + "60", minus + "40", minus + "20", "0", "20"});
    CHECK(tick_labels(round_ticks(-60, 20, 4)).factor.empty());
    const Labels huge = tick_labels(round_ticks(0, 2e7, 4));
    CHECK(huge.texts == Texts{"0.0", "0.5", "1.0", "1.5", "2.0"});
    CHECK(huge.factor ==
          " (\xc3\x97"
          "10\xe2\x81\xb7)");
    const Labels tiny = tick_labels(round_ticks(0, 3e-7, 3));
    CHECK(tiny.texts == Texts{"0", "1", "2", "3"});
    CHECK(tiny.factor ==
          " (\xc3\x97"
          "10\xe2\x81\xbb\xe2\x81\xb7)");
    CHECK(number_labels(List{-1.5, 0.001, 1e20}).texts == Texts{minus + "1.5", "0.001", "1e+20"});
}

TEST_CASE("levels cover the typical values; far ones do not stretch them") {
    List samples = ramp(-1, 2, 10000);
    samples.push_back(1e9);
    samples.push_back(-inf);
    samples.push_back(undefined);
    const Levels levels = choose_levels(samples, 12);
    CHECK(levels.lowest == -inf);
    CHECK(levels.highest == 1e9);
    CHECK(levels.defined == 10002);
    CHECK(levels.undefined == 1);
    CHECK(levels.uniform);
    CHECK(levels.values.size() >= 7);
    CHECK(levels.values.size() <= 18);
    CHECK(levels.values.front() >= -1);
    CHECK(levels.values.back() <= 2);
    CHECK(std::find(levels.values.begin(), levels.values.end(), 0.0) != levels.values.end());
}

TEST_CASE("zero is a level as soon as both signs occur, however rare one is") {
    List samples = ramp(5, 6, 10000);
    CHECK(choose_levels(samples, 10).values.front() >= 5);
    samples.push_back(-0.001);
    CHECK(choose_levels(samples, 10).values.front() == 0);
    List outside = ramp(-100, -1, 10000);
    outside.push_back(0);
    CHECK(choose_levels(outside, 10).values.back() == 0);
}

TEST_CASE("levels of constant, single and absent values") {
    CHECK(choose_levels(List(100, 3.0), 10).values == List{0});
    CHECK(choose_levels(List(100, undefined), 10).values == List{0});
    CHECK(choose_levels(List(100, undefined), 10).defined == 0);
    CHECK(choose_levels(List(100, inf), 10).values == List{0});
    CHECK(choose_levels({}, 10).values == List{0});
    List mostly(1000, 1.0);
    mostly[3] = 2;
    CHECK(choose_levels(mostly, 10).values.size() > 3);
}

TEST_CASE("given levels are sorted and gain a zero where the sign changes") {
    CHECK(given_levels(ramp(-1, 1, 9), {3, -2, 3, 1}).values == List{-2, 0, 1, 3});
    CHECK(given_levels(ramp(1, 2, 9), {1.5}).values == List{1.5});
    CHECK(given_levels(ramp(-1, 1, 9), {-0.0, 1}).values == List{0, 1});
}

TEST_CASE("the color scale: light in the middle, evenly darker to both sides, warm inside, cool outside") {
    double previous = oklab_lightness(diverging_color(0));
    CHECK(previous > 0.95);
    for (int i = 1; i <= 10; ++i) {
        const Color warm = diverging_color(i / 10.0), cool = diverging_color(-i / 10.0);
        CHECK(warm.r > warm.b);
        CHECK(cool.b > cool.r);
        const double lightness = oklab_lightness(warm);
        CHECK(lightness == doctest::Approx(oklab_lightness(cool)).epsilon(0.02));
        CHECK(previous - lightness == doctest::Approx(0.0505).epsilon(0.25));
        previous = lightness;
    }
    CHECK(diverging_color(7) == diverging_color(1));
}

TEST_CASE("bands") {
    const List levels{-2, -1, 0, 1};
    CHECK(band_of(levels, -5) == 0);
    CHECK(band_of(levels, -inf) == 0);
    CHECK(band_of(levels, -2) == 1);
    CHECK(band_of(levels, -1e-300) == 2);
    CHECK(band_of(levels, 0) == 3);
    CHECK(band_of(levels, inf) == 4);
    const std::vector<Color> colors = band_colors(levels);
    REQUIRE(colors.size() == 5);
    for (std::size_t i = 0; i < 3; ++i) CHECK(colors[i].b > colors[i].r);
    for (std::size_t i = 3; i < 5; ++i) CHECK(colors[i].r > colors[i].b);
    CHECK(band_colors(List{0}).size() == 2);
}
