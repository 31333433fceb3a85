// Helpers of tests that start from HyperFun text: a model's values at a point through an engine.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "frep/frep.h"

namespace frep::test {

inline std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// What a model gives at a point: diagnostics, and F with the attributes when there was no error.
struct Outcome {
    Diagnostics diagnostics;
    bool ok = false;
    std::vector<double> values;  ///< F, s[1], s[2], ...
    bool has_regions = false;
    std::vector<bool> structural;
    std::uint32_t first_error_line = 0;
};

inline Outcome evaluate(const std::string& text, const std::string& object, std::vector<double> x,
                        const std::vector<double>& a, Engine engine = Engine::vm, int registers = 0) {
    Outcome out;
    const Model model(Source("test.hf", text));
    out.diagnostics = model.diagnostics();
    const auto index = model.ok() ? model.find_object(object) : std::nullopt;
    if (index || (model.ok() && !model.program().objects.empty())) {
        auto lowered = model.lower(index.value_or(0), a, out.diagnostics);
        if (lowered) {
            out.ok = true;
            out.has_regions = lowered->has_regions;
            out.structural = lowered->structural;
            auto evaluator = make_evaluator(
                lowered->field,
                {.engine = engine, .compile_at_once = true, .attributes = true, .registers = registers});
            x.resize(static_cast<std::size_t>(lowered->field.coordinates), 0.0);
            std::vector<const double*> coordinates;
            for (const double& value : x) coordinates.push_back(&value);
            out.values.resize(1 + lowered->field.attributes.size());
            std::vector<double*> results;
            for (double& value : out.values) results.push_back(&value);
            (*evaluator)->values(coordinates, 1, results);
        }
    }
    for (const Diagnostic& d : out.diagnostics.list())
        if (d.severity == Severity::error && out.first_error_line == 0)
            out.first_error_line = model.source().locate(d.span.begin).line;
    return out;
}

/// F alone, NaN when there is none.
inline double value_of(const std::string& text, std::vector<double> x, const std::vector<double>& a = {},
                       Engine engine = Engine::vm) {
    const Outcome out = evaluate(text, "", std::move(x), a, engine);
    return out.ok ? out.values[0] : __builtin_nan("");
}

inline bool close(double a, double b, double tolerance) {
    if (a == b) return true;
    const double scale = std::max(1.0, b < 0 ? -b : b);
    return (a > b ? a - b : b - a) <= tolerance * scale;
}

}  // namespace frep::test
