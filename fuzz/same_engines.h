// What the fuzzers of models share: all engines give the same bits.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "frep/frep.h"

namespace frep::fuzz {

/// Evaluates the field at two points by every engine; ends the process where bits differ.
inline void compare_engines(const Field& field) {
    constexpr std::int64_t loop_steps = 200;
    constexpr int count = 2;
    const double points[count] = {0.5, -1.25};
    const std::vector<const double*> coordinates(static_cast<std::size_t>(field.coordinates), points);
    std::optional<std::vector<double>> first;
    for (const EngineInfo& info : engines()) {
        const auto evaluator = make_evaluator(field, {.engine = info.engine, .max_steps = loop_steps});
        if (!evaluator) continue;
        std::vector<double> values(count);
        double* out = values.data();
        (*evaluator)->values(coordinates, count, std::span<double* const>(&out, 1));
        if (!first) first = values;
        for (int p = 0; p < count; ++p) {
            const double a = values[static_cast<std::size_t>(p)], b = (*first)[static_cast<std::size_t>(p)];
            const bool same = std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
            if (!same && !(a != a && b != b)) std::abort();
        }
    }
}

}  // namespace frep::fuzz
