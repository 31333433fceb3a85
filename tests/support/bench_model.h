// The models of the benches, which are shared data.
#pragma once

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "support/evaluate.h"

namespace frep::test {

/// The field of bench/models/NAME of the shared data; without these a line that the test was skipped, and
/// nothing.
inline std::optional<Field> bench_field(const std::string& name) {
    const char* const shared = std::getenv("FREP_SHARED");
    const std::string text =
        read_text(std::string(shared != nullptr ? shared : "") + "/bench/models/" + name);
    if (text.empty()) {
        std::printf("skipped: 1 (no %s)\n", name.c_str());
        return std::nullopt;
    }
    const Model model(Source(name, text), {}, ModelText::vm);
    const auto field = model.field();
    REQUIRE(static_cast<bool>(field));
    return *field;
}

}  // namespace frep::test
