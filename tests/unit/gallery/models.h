// The models of the gallery, and those of the benches where there are shared data, for tests over all of
// them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "frep/frep.h"

namespace frep::test {

inline const std::filesystem::path examples = std::filesystem::path(FREP_SOURCE_DIR) / "examples";

/// Files of a folder with that extension, in order of their names.
inline std::vector<std::filesystem::path> models_in(const std::filesystem::path& folder,
                                                    const char* extension = ".hf") {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == extension) out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

/// The solids of the gallery and, where FREP_SHARED has them, the models of the benches.
inline std::vector<std::filesystem::path> solids() {
    std::vector<std::filesystem::path> out = models_in(examples);
    const char* shared = std::getenv("FREP_SHARED");
    const std::filesystem::path benches = std::filesystem::path(shared ? shared : "") / "bench" / "models";
    if (shared && std::filesystem::is_directory(benches)) {
        for (const auto& path : models_in(benches, ".vm")) out.push_back(path);
    } else {
        std::puts("skipped: 1 (FREP_SHARED has no models of the benches)");
    }
    return out;
}

struct Loaded {
    Model model;
    Field field;
    Box3 box;
};

/// The model with its default parameters; there must be no warning. Without bounds of its own the box is
/// [-1, 1]^3.
inline Loaded load(const std::filesystem::path& path) {
    auto model = compile_file(path.string());
    REQUIRE_MESSAGE(static_cast<bool>(model), (model ? "" : model.error().message));
    Diagnostics findings = model->diagnostics();
    const auto object = model->find_object("");
    REQUIRE(object);
    const auto lowered = model->lower(*object, model->complete_parameters(*object, {}), findings);
    for (const Diagnostic& finding : findings.list())
        CHECK_MESSAGE(finding.severity == Severity::note, render(findings, model->source()));
    REQUIRE(lowered);
    std::vector<double> pairs = model->program().annotations.bounds;
    const auto n = static_cast<std::size_t>(lowered->field.coordinates);
    if (path.extension() == ".vm") {
        pairs = {-1, 1, -1, 1, -1, 1};
    } else {
        REQUIRE(pairs.size() == 2 * n);
    }
    pairs.resize(std::max<std::size_t>(pairs.size(), 6));
    if (n == 2) pairs[4] = -1, pairs[5] = 1;
    return {
        std::move(*model), lowered->field, {{pairs[0], pairs[2], pairs[4]}, {pairs[1], pairs[3], pairs[5]}}};
}

}  // namespace frep::test
