// The engine jit: the bits of the vm before and after it compiles, from several threads, and where there is
// nothing to compile.
#include "frep/eval/jit_evaluator.h"

#include <doctest/doctest.h>

#include <atomic>
#include <string>

#include "frep/base/parallel.h"
#include "frep/eval/native_code.h"
#include "support/bench_model.h"
#include "support/evaluate.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

Columns<double> random_points(Random& random, std::size_t columns, std::size_t rows) {
    Columns<double> points(columns, rows);
    for (auto& column : points.columns)
        for (double& x : column) x = random_coordinate(random);
    return points;
}

Field random_field(std::uint64_t seed, int attributes) {
    RandomOptions options;
    options.operations = 40;
    options.region_percent = 0;
    options.attributes = attributes;
    return RandomField(seed, options).make();
}

/// Values of F that two evaluators give in calls of these sizes, where they differ.
std::size_t differing(Evaluator& a, Evaluator& b, std::span<const std::size_t> sizes, Random& random) {
    std::size_t count = 0;
    for (const std::size_t rows : sizes) {
        const auto points = random_points(random, static_cast<std::size_t>(a.coordinates()), rows);
        count += differences(values_of(a, points, rows), values_of(b, points, rows));
    }
    return count;
}

}  // namespace

TEST_CASE("the engines of this machine") {
    CHECK(engines().size() == (has_jit() ? 3 : 2));
    CHECK(engines().back().engine == (has_jit() ? Engine::jit : Engine::vm));
    CHECK(has_jit() == NativeCode<double>::is_available());
}

TEST_CASE("jit gives the bits of the vm, whether it compiles at once or when it pays") {
    Random random(7);
    const std::size_t sizes[] = {1, 9, 1000, 9000, 17, 300};
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        // with attributes among them, which the vm evaluates
        const Field field = random_field(seed, seed % 3 == 0 ? 2 : 0);
        const auto vm = engine(field, Engine::vm), at_once = engine(field, Engine::jit);
        REQUIRE(vm);
        REQUIRE(at_once);
        auto later = make_evaluator(field, {.attributes = !field.attributes.empty()});
        REQUIRE(static_cast<bool>(later));
        CHECK(differing(*vm, *at_once, sizes, random) == 0);
        CHECK(differing(*vm, **later, sizes, random) == 0);
        CHECK(at_once->outputs() == vm->outputs());
        CHECK((at_once->clauses() == nullptr) == (vm->clauses() == nullptr));
    }
}

TEST_CASE("clones of jit share what they compile, from any thread") {
    Random random(8);
    const Field field = random_field(3, 0);
    const auto vm = engine(field, Engine::vm);
    const auto jit = make_evaluator(field);
    REQUIRE(static_cast<bool>(jit));
    constexpr std::size_t rows = 2000;
    const auto points = random_points(random, static_cast<std::size_t>(vm->coordinates()), rows);
    const auto expected = values_of(*vm, points, rows);
    std::vector<std::unique_ptr<Evaluator>> clones;
    for (int i = 0; i < 64; ++i) clones.push_back((*jit)->clone());
    std::atomic<std::size_t> wrong = 0;
    Job job;
    job.threads = 4;
    parallel_for(job, clones.size(),
                 [&](std::size_t i) { wrong += differences(expected, values_of(*clones[i], points, rows)); });
    CHECK(wrong == 0);
}

// More values than registers: one that ends is read from memory while others go there (native_writer.h).
TEST_CASE("jit gives the bits of the vm for Prospero") {
    const auto field = test::bench_field("prospero.vm");
    if (!field) return;
    Random random(9);
    Columns<double> points(static_cast<std::size_t>(field->coordinates), 4096);
    for (auto& column : points.columns)
        for (double& x : column) x = random.real(-1, 1);
    const auto vm = engine(*field, Engine::vm), jit = engine(*field, Engine::jit);
    CHECK(differences(values_of(*vm, points, 4096), values_of(*jit, points, 4096)) == 0);
}
