// libFuzzer target: a HyperFun file all the way: parse, lower every object, render the diagnostics, evaluate
// at two points by both engines. Crashes, hangs, sanitizer reports and differing bits are findings.
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "frep/frep.h"

namespace {

constexpr std::int64_t step_limit = 20'000;
constexpr std::int64_t loop_steps = 200;

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

void evaluate(const frep::Field& field) {
    const double points[2] = {0.5, -1.25};
    const std::vector<const double*> coordinates(static_cast<std::size_t>(field.coordinates), points);
    double values[2][2] = {};
    int row = 0;
    for (frep::Engine engine : {frep::Engine::reference, frep::Engine::vm}) {
        auto evaluator = frep::make_evaluator(field, {.engine = engine, .max_steps = loop_steps});
        if (!evaluator) return;
        double* out = values[row++];
        (*evaluator)->values(coordinates, 2, std::span<double* const>(&out, 1));
    }
    for (int p = 0; p < 2; ++p)
        if (!same_bits(values[0][p], values[1][p])) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const frep::Model model(frep::Source("fuzz.hf", {reinterpret_cast<const char*>(data), size}));
    static_cast<void>(frep::render(model.diagnostics(), model.source()));
    if (!model.ok()) return 0;
    for (std::size_t object = 0; object < model.program().objects.size() && object < 4; ++object) {
        frep::Diagnostics found;
        const auto lowered = frep::lang::lower(model.program(), object,
                                               {.parameters = {1, 2}, .step_limit = step_limit}, found);
        static_cast<void>(frep::render(found, model.source()));
        if (lowered && lowered->field.graph->size() < 20'000) evaluate(lowered->field);
    }
    return 0;
}
