// libFuzzer target: a HyperFun file all the way: parse, lower every object, render the diagnostics, evaluate
// at two points by all engines. Crashes, hangs, sanitizer reports and differing bits are findings.
#include <cstdint>

#include "same_engines.h"

namespace {
constexpr std::int64_t step_limit = 20'000;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const frep::Model model(frep::Source("fuzz.hf", {reinterpret_cast<const char*>(data), size}));
    static_cast<void>(frep::render(model.diagnostics(), model.source()));
    if (!model.ok()) return 0;
    for (std::size_t object = 0; object < model.program().objects.size() && object < 4; ++object) {
        frep::Diagnostics found;
        const auto lowered = frep::lang::lower(model.program(), object,
                                               {.parameters = {1, 2}, .step_limit = step_limit}, found);
        static_cast<void>(frep::render(found, model.source()));
        if (lowered && lowered->field.graph->size() < 20'000) frep::fuzz::compare_engines(lowered->field);
    }
    return 0;
}
