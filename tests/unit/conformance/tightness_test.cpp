// Intervals over small boxes: every sampled value lies inside, and for nine of ten library models the
// enclosure of a box of half-width 1e-3 is at most 100 times as wide as the range of the samples.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "support/evaluate.h"
#include "support/random_program.h"

using namespace frep;

namespace {

constexpr int boxes_a_model = 20;
constexpr std::size_t samples_a_box = 125;  // 5^3 lattice, corners included

struct Box {
    double center[3];
    double half_width = 1e-3;
};

/// Ratio of the enclosure's width to the range of the samples; checks that no sample lies outside.
double width_ratio(Evaluator& evaluator, const Box& box) {
    std::vector<double> x[3];
    for (std::size_t s = 0; s < samples_a_box; ++s) {
        const std::size_t lattice[3] = {s % 5, s / 5 % 5, s / 25};
        for (int i = 0; i < 3; ++i)
            x[i].push_back(box.center[i] + box.half_width * (static_cast<double>(lattice[i]) / 2.0 - 1.0));
    }
    const double* coordinates[] = {x[0].data(), x[1].data(), x[2].data()};
    std::vector<double> values(samples_a_box);
    double* out = values.data();
    evaluator.values(coordinates, samples_a_box, std::span<double* const>(&out, 1));
    math::Interval ranges[3];
    const math::Interval* spans[3];
    for (int i = 0; i < 3; ++i) {
        ranges[i] = math::Interval(box.center[i] - box.half_width, box.center[i] + box.half_width);
        spans[i] = &ranges[i];
    }
    math::Interval enclosure;
    evaluator.intervals(spans, 1, &enclosure);
    double low = math::infinity, high = -math::infinity;
    for (double value : values) {
        if (value != value) {
            CHECK((enclosure.maybe_undefined || enclosure.is_empty()));
            continue;
        }
        CHECK(enclosure.contains(value));
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (enclosure.is_empty() || low > high) return 0;
    const double width = enclosure.hi - enclosure.lo;
    const double rounding = 1e-12 * std::max({1.0, high, -low});  // a constant function has range 0
    return width / std::max(high - low, rounding);
}

}  // namespace

TEST_CASE("enclosures of small boxes are sound and tight") {
    namespace fs = std::filesystem;
    int models = 0, tight = 0;
    for (const auto& entry : fs::directory_iterator(FREP_SOURCE_DIR "/tests/conformance/library")) {
        if (entry.path().extension() != ".hf") continue;
        const std::string name = entry.path().stem().string();
        CAPTURE(name);
        const auto field = Model(Source(name, test::read_text(entry.path().string()))).field();
        REQUIRE(static_cast<bool>(field));
        REQUIRE_FALSE(has_regions(*field));
        for (Engine engine : {Engine::reference, Engine::vm}) {
            auto evaluator = make_evaluator(*field, {.engine = engine});
            test::RandomProgram random(static_cast<std::uint64_t>(models + 1));
            std::vector<double> ratios;
            for (int b = 0; b < boxes_a_model; ++b) {
                Box box;
                for (double& c : box.center) c = random.number() + random.number() / 16.0;
                ratios.push_back(width_ratio(**evaluator, box));
            }
            std::sort(ratios.begin(), ratios.end());
            const double worst_of_most = ratios[boxes_a_model * 9 / 10 - 1];
            if (engine == Engine::vm) {
                ++models;
                if (worst_of_most <= 100)
                    ++tight;
                else
                    MESSAGE(name << ": " << worst_of_most);
            }
        }
    }
    MESSAGE(tight << " of " << models << " models are tight");
    CHECK(10 * tight >= 9 * models);
}
