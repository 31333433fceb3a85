// The library functions against values of the old interpreter (tests/conformance/library), through both
// engines.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "support/evaluate.h"

using namespace frep;

namespace {

struct Sample {
    std::vector<double> point;
    double value = 0;
};

std::vector<Sample> read_samples(const std::string& path) {
    std::vector<Sample> samples;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream in(line);
        Sample sample;
        std::string word;
        bool after_arrow = false;
        while (in >> word) {
            if (word == "->")
                after_arrow = true;
            else if (after_arrow)
                sample.value = std::stod(word);
            else
                sample.point.push_back(std::stod(word));
        }
        if (after_arrow) samples.push_back(sample);
    }
    return samples;
}

/// The old code itself is approximate in these (tests/conformance/README.md).
double tolerance_of(const std::string& name) {
    const bool approximate =
        name.starts_with("hfConvArc") || name.starts_with("hfDEllipsoid") || name.starts_with("hfDCylinder");
    return approximate ? 5e-6 : 1e-9;
}

}  // namespace

TEST_CASE("library values of the old interpreter") {
    namespace fs = std::filesystem;
    const fs::path folder = FREP_SOURCE_DIR "/tests/conformance/library";
    std::size_t functions = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".hf") continue;
        const std::string name = entry.path().stem().string();
        CAPTURE(name);
        ++functions;
        const auto samples = read_samples((folder / (name + ".values.txt")).string());
        REQUIRE_FALSE(samples.empty());
        const Model model(Source(name, test::read_text(entry.path().string())));
        REQUIRE_MESSAGE(model.ok(), render(model.diagnostics(), model.source()));
        const auto field = model.field();
        REQUIRE(static_cast<bool>(field));
        for (Engine engine : {Engine::reference, Engine::vm, Engine::jit}) {
            auto evaluator = make_evaluator(*field, {.engine = engine, .compile_at_once = true});
            REQUIRE(static_cast<bool>(evaluator));
            for (const Sample& sample : samples) {
                std::vector<const double*> coordinates;
                for (const double& c : sample.point) coordinates.push_back(&c);
                double value = 0;
                double* out = &value;
                (*evaluator)->values(coordinates, 1, std::span<double* const>(&out, 1));
                CAPTURE(sample.point[0]);
                CAPTURE(sample.point[1]);
                CAPTURE(sample.point[2]);
                CAPTURE(value);
                CAPTURE(sample.value);
                CHECK(test::close(value, sample.value, tolerance_of(name)));
            }
        }
    }
    CHECK(functions >= 85);
}
