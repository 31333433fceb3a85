// libFuzzer target: a model in the `.vm` text form all the way: parse, lift its set operations or not, render
// the diagnostics, evaluate at two points by all engines. Crashes, hangs, sanitizer reports and differing
// bits are findings.
#include <cstdint>

#include "same_engines.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const frep::Model model(frep::Source("fuzz.vm", {reinterpret_cast<const char*>(data), size}), {},
                            frep::ModelText::vm);
    static_cast<void>(frep::render(model.diagnostics(), model.source()));
    if (!model.ok()) return 0;
    for (const bool lift : {true, false}) {
        frep::Diagnostics found;
        const auto lowered = model.lower(0, {}, found, lift);
        static_cast<void>(frep::render(found, model.source()));
        if (lowered && lowered->field.graph->size() < 20'000) frep::fuzz::compare_engines(lowered->field);
    }
    return 0;
}
