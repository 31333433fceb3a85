// `frep mesh` writes the same bytes in every format for every number of threads, with and without pruning,
// and the same report apart from "run".
#include <doctest/doctest.h>

#include "case_file.h"
#include "process.h"

namespace {

using namespace frep::test;

constexpr const char* solid_text = R"(--@ title Two balls
--@ units cm
--@ color 0.2 0.4 0.6
my_model(x[3], a[1], s[3])
{
  one = 1 - (x[1] - 0.5)^2 - x[2]^2 - x[3]^2;
  two = 1 - (x[1] + 0.7)^2 - x[2]^2 - x[3]^2;
  s[1] = 0.5 + 0.4 * x[1];
  s[2] = 0.5 + 0.4 * x[2];
  s[3] = 0.5;
  my_model = one | two;
}
)";
constexpr const char* flat_text = R"(my_model(x[2], a[1])
{
  my_model = (1 - x[1]^2 - x[2]^2) & (x[1]^2 + (x[2] - 0.3)^2 - 0.2);
}
)";

std::string bytes_of(const ScratchFolder& folder, const std::string& arguments, const std::string& file) {
    Process process(split_words("mesh " + arguments + " -o " + file + " --quiet"), folder.path(), "", {});
    const Outcome outcome = process.wait();
    INFO(arguments, "\n", outcome.err);
    REQUIRE(outcome.exit == 0);
    return read_bytes(folder.path() / file);
}

}  // namespace

TEST_CASE("mesh: the same bytes for every number of threads in every format") {
    const ScratchFolder folder;
    write_bytes(folder.path() / "solid.hf", solid_text);
    write_bytes(folder.path() / "flat.hf", flat_text);
    struct Row {
        std::string model, file, more;
        bool ignores_pruning = true;
    };
    std::vector<Row> rows;
    for (const char* extension : {"stl", "ply", "obj", "off", "glb", "wrl", "x3d", "3mf", "pov"})
        rows.push_back(
            {"solid.hf", std::string("out.") + extension, " --grid 30 --bounds -1.6,1.2 --method cells"});
    rows.push_back({"solid.hf", "capped.ply", " --grid 30 --bounds -1.6,1.2 --cap --iso 0.1 --method cells"});
    // Here pruning changes the last digits of vertices (docs/decisions/0014-adaptive-mesh.md).
    rows.push_back({"solid.hf", "adaptive.ply", " --grid 30 --bounds -1.6,1.2 --cap --iso 0.1", false});
    rows.push_back({"solid.hf", "merged.ply", " --grid 30 --bounds -1.6,1.2 --tolerance 0.02", false});
    rows.push_back({"solid.hf", "out.cli", " --layer 0.1"});
    for (const char* extension : {"svg", "dxf"})
        rows.push_back({"flat.hf", std::string("flat.") + extension, ""});
    rows.push_back({"solid.hf", "section.svg", " --map x,y,0.1"});
    for (const Row& row : rows) {
        CAPTURE(row.file);
        const std::string one = bytes_of(folder, row.model + row.more + " -j 1", row.file);
        CHECK(one.size() > 500);
        for (const char* other : {" -j 2", " -j 8", " -j 2 --no-prune"})
            if (row.ignores_pruning || !std::string_view(other).ends_with("--no-prune"))
                CHECK(bytes_of(folder, row.model + row.more + other, row.file) == one);
    }
    const std::string report = " --grid 20 --report r.json";
    const auto without_run = [&](const char* threads) {
        bytes_of(folder, "solid.hf" + report + threads, "out.stl");
        const std::string text = read_bytes(folder.path() / "r.json");
        return text.substr(0, text.find("\"run\""));
    };
    const std::string one = without_run(" -j 1");
    CHECK(one.find("max_error") != std::string::npos);
    CHECK(without_run(" -j 8") == one);
}
