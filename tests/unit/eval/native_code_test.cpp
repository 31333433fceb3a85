// Native code against the reference engine, and in binary32 against BatchVm, bit by bit: random fields of
// every operation, with and without a domain, for each instruction set that this machine has; its memory and
// its instructions.
#include "frep/eval/native_code.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#if defined(__linux__)
#include <unistd.h>
#endif

#include "frep/eval/batch_vm.h"
#include "unit/eval/engines.h"
#include "unit/eval/random_graph.h"

using namespace frep;
using namespace frep_test;

namespace {

std::vector<Isa> sets() {
    std::vector<Isa> all;
    for (const Isa isa : {Isa::avx2, Isa::avx512})
        if (isa <= machine_isa()) all.push_back(isa);
    return all;
}

bool unavailable() {
    if (NativeCode<double>::is_available()) return false;
    std::puts("skipped: 1 (no native code in this build or on this machine)");
    return true;
}

Columns<double> random_points(Random& random, std::size_t columns, std::size_t rows) {
    Columns<double> points(columns, rows);
    for (auto& column : points.columns)
        for (double& x : column) x = random_coordinate(random);
    return points;
}

/// Points where native code and the reference engine differ.
std::size_t differing(const Field& field, const Columns<double>& points, const NativeOptions& options) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape.has_value());
    const auto code = NativeCode<double>::compile(*tape, options);
    REQUIRE(code.has_value());
    Field alone = field;
    alone.attributes.clear();
    const auto reference = engine(alone, Engine::reference);
    REQUIRE(reference);
    const std::size_t rows = points.rows();
    const auto expected = values_of(*reference, points, rows).columns[0];
    std::vector<double> got(rows + 1, 12345.0);
    code->run(points.in().data(), rows, got.data());
    CHECK(got[rows] == 12345.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows; ++i) count += same(got[i], expected[i]) ? 0 : 1;
    return count;
}

bool same(float a, float b) { return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0; }
using frep_test::same;

Columns<float> rounded(const Columns<double>& points) {
    Columns<float> result(points.columns.size(), points.rows());
    for (std::size_t k = 0; k < points.columns.size(); ++k)
        for (std::size_t i = 0; i < points.rows(); ++i)
            result.columns[k][i] = static_cast<float>(points.columns[k][i]);
    return result;
}

/// The same in binary32, against BatchVm.
std::size_t differing_singles(const Field& field, const Columns<double>& points,
                              const NativeOptions& options) {
    const auto tape = make_clause_tape(field);
    REQUIRE(tape.has_value());
    const auto code = NativeCode<float>::compile(*tape, options);
    REQUIRE(code.has_value());
    const Columns<float> at = rounded(points);
    std::vector<float> expected(points.rows()), got(points.rows());
    BatchVm<float> vm;
    vm.values(*tape, at.in(), points.rows(), expected.data());
    code->run(at.in().data(), points.rows(), got.data());
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.rows(); ++i) count += same(got[i], expected[i]) ? 0 : 1;
    return count;
}

Field random_field(std::uint64_t seed, int operations) {
    RandomOptions options;
    options.operations = operations;
    options.region_percent = 0;
    options.attributes = 0;
    return RandomField(seed, options).make();
}

/// One operation on the first coordinates.
Field field_of(Op op) {
    auto graph = std::make_shared<Graph>();
    Field field;
    field.coordinates = std::max(info(op).arity, 1);
    std::vector<NodeId> in;
    for (int i = 0; i < info(op).arity; ++i) in.push_back(graph->coordinate(i));
    field.value = graph->make(op, in);
    field.graph = std::move(graph);
    return field;
}

}  // namespace

TEST_CASE("each operation as native code gives what the reference engine gives") {
    if (unavailable()) return;
    for (int k = 0; k < op_count; ++k) {
        const Op op = static_cast<Op>(k);
        if (info(op).kind != OpKind::plain) continue;
        Random random(static_cast<std::uint64_t>(k));
        const Field field = field_of(op);
        const auto points = random_points(random, static_cast<std::size_t>(field.coordinates), 1003);
        for (const Isa isa : sets()) {
            INFO(info(op).name, " ", name_of(isa));
            CHECK(differing(field, points, {isa, {}}) == 0);
            CHECK(differing_singles(field, points, {isa, {}}) == 0);
        }
    }
}

TEST_CASE("random fields as native code") {
    if (unavailable()) return;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const Field field = random_field(seed, 3 + static_cast<int>(seed % 90));
        Random random(seed);
        const auto points = random_points(random, 3, 1 + seed % 67);
        const std::vector<math::Interval> domain(3,
                                                 math::Interval(-2.5, 2.0 + static_cast<double>(seed % 3)));
        for (const Isa isa : sets()) {
            INFO("seed ", seed, " ", name_of(isa));
            CHECK(differing(field, points, {isa, {}}) == 0);
            CHECK(differing(field, points, {isa, domain}) == 0);
            CHECK(differing_singles(field, points, {isa, {}}) == 0);
            CHECK(differing_singles(field, points, {isa, domain}) == 0);
        }
    }
}

TEST_CASE("a coordinate and a constant as roots, and no points") {
    if (unavailable()) return;
    auto graph = std::make_shared<Graph>();
    Field field;
    field.coordinates = 3;
    const NodeId y = graph->coordinate(1), half = graph->constant(0.5);
    field.graph = graph;
    Random random(1);
    const auto points = random_points(random, 3, 21);
    for (const NodeId root : {y, half}) {
        field.value = root;
        for (const Isa isa : sets()) {
            CHECK(differing(field, points, {isa, {}}) == 0);
            CHECK(differing_singles(field, points, {isa, {}}) == 0);
        }
    }
    const auto code = NativeCode<double>::compile(*make_clause_tape(field));
    double none = 7;
    code->run(points.in().data(), 0, &none);
    CHECK(none == 7);
}

TEST_CASE("long tapes: more values alive than registers, and more coordinates than pointers") {
    if (unavailable()) return;
    // Every difference is used twice, far apart.
    auto graph = std::make_shared<Graph>();
    Field field;
    field.coordinates = 14;
    std::vector<NodeId> values;
    for (int i = 0; i < 10000; ++i)
        values.push_back(graph->make(Op::sub, {graph->coordinate(i % 14), graph->constant(0.001 * i)}));
    NodeId sum = graph->constant(0.0);
    for (const NodeId v : values) sum = graph->make(Op::max, {graph->make(Op::neg, {sum}), v});
    for (const NodeId v : values)
        sum = graph->make(Op::min, {graph->make(Op::neg, {sum}), graph->make(Op::sin, {v})});
    field.value = sum;
    field.graph = graph;
    Random random(5);
    const auto points = random_points(random, 14, 50);
    for (const Isa isa : sets()) {
        CHECK(differing(field, points, {isa, {}}) == 0);
        CHECK(differing_singles(field, points, {isa, {}}) == 0);
    }
}

TEST_CASE("random fields of many operations as native code") {
    if (unavailable()) return;
    for (std::uint64_t seed = 1000; seed < 1006; ++seed) {
        const Field field = random_field(seed, 3000);
        Random random(seed);
        const auto points = random_points(random, 3, 100);
        const std::vector<math::Interval> domain(3, math::Interval(-3, 3));
        for (const Isa isa : sets()) {
            INFO("seed ", seed, " ", name_of(isa));
            CHECK(differing(field, points, {isa, domain}) == 0);
            CHECK(differing_singles(field, points, {isa, domain}) == 0);
        }
    }
}

TEST_CASE("it pays for many points only") {
    if (unavailable()) return;
    const auto tape = make_clause_tape(random_field(3, 50));
    CHECK(!native_code_pays<double>(*tape, 16));
    CHECK(native_code_pays<double>(*tape, 10'000'000));
    CHECK(native_code_pays<float>(*tape, 10'000'000));
}

#if defined(__linux__)

TEST_CASE("no memory is writable and executable at a time") {
    if (unavailable()) return;
    std::vector<NativeCode<double>> codes;
    // Small ones from the pool, and one of a mapping of its own; some are freed and their place used again.
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        auto code = NativeCode<double>::compile(*make_clause_tape(random_field(seed, 30)));
        REQUIRE(code.has_value());
        codes.push_back(std::move(*code));
        if (seed % 3 == 0) codes.erase(codes.begin());
    }
    std::optional<NativeCode<double>> large;
    for (std::uint64_t seed = 1001; seed < 1100 && !(large && large->bytes().size() > 65536); ++seed)
        large = NativeCode<double>::compile(*make_clause_tape(random_field(seed, 4000)));
    REQUIRE(large.has_value());
    REQUIRE(large->bytes().size() > 65536);
    const auto address = [](const NativeCode<double>& code) {
        return reinterpret_cast<std::uintptr_t>(code.bytes().data());
    };
    std::ifstream maps("/proc/self/maps");
    std::string line;
    std::size_t lines = 0, found = 0;
    while (std::getline(maps, line)) {
        ++lines;
        const auto dash = line.find('-'), blank = line.find(' ');
        const std::uintptr_t begin = std::stoull(line.substr(0, dash), nullptr, 16);
        const std::uintptr_t end = std::stoull(line.substr(dash + 1, blank - dash - 1), nullptr, 16);
        const std::string rights = line.substr(blank + 1, 4);
        INFO(line);
        CHECK((rights[1] != 'w' || rights[2] != 'x'));
        for (const auto* code : {&codes.front(), &codes.back(), &*large}) {
            if (address(*code) < begin || address(*code) >= end) continue;
            ++found;
            CHECK(rights.substr(0, 3) == "r-x");
        }
    }
    CHECK(lines > 0);
    CHECK(found == 3);
}

/// The mnemonics of a piece of code, by objdump; nothing when that is not there.
std::vector<std::string> mnemonics(std::span<const std::uint8_t> bytes) {
    const auto file = std::filesystem::temp_directory_path() / ("frep_native_" + std::to_string(getpid()));
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const std::string command =
        "objdump -D -b binary -m i386:x86-64 --no-show-raw-insn " + file.string() + " 2>/dev/null";
    std::vector<std::string> found;
    if (FILE* pipe = popen(command.c_str(), "r")) {
        char line[512];
        while (std::fgets(line, sizeof line, pipe)) {
            std::istringstream words(line);
            std::string place, word;
            const bool listed = words >> place >> word && place.back() == ':';
            if (listed && place.find_first_not_of("0123456789abcdef:") == std::string::npos)
                found.push_back(word);
        }
        pclose(pipe);
    }
    std::filesystem::remove(file);
    return found;
}

TEST_CASE("the instructions are those that compute, and one return a code") {
    if (unavailable()) return;
    const std::set<std::string> plain = {"mov", "movabs", "push", "pop",    "add", "sub",  "cmp",  "test",
                                         "lea", "dec",    "je",   "jne",    "jae", "jmp",  "call", "ret",
                                         "nop", "nopw",   "nopl", "data16", "cs",  "xchg", "int3"};
    for (const Isa isa : sets()) {
        INFO(name_of(isa));
        std::vector<std::uint8_t> bytes;
        std::size_t codes = 0;
        const auto add = [&](const auto& code) {
            REQUIRE(code.has_value());
            // Constants stand behind the code, from a border of 64 bytes on; they are no instructions.
            const auto part = code->bytes().first(code->statistics().code_bytes);
            bytes.insert(bytes.end(), part.begin(), part.end());
            ++codes;
        };
        const auto add_both = [&](const Field& field) {
            const auto tape = make_clause_tape(field);
            add(NativeCode<double>::compile(*tape, {isa, {}}));
            add(NativeCode<float>::compile(*tape, {isa, {}}));
        };
        for (int k = 0; k < op_count; ++k)
            if (const Op op = static_cast<Op>(k); info(op).kind == OpKind::plain) add_both(field_of(op));
        for (const int operations : {1, 60, 500}) add_both(random_field(17, operations));
        const auto listed = mnemonics(bytes);
        if (listed.empty()) {
            std::puts("skipped: 1 (no objdump)");
            return;
        }
        std::size_t returns = 0;
        for (const std::string& word : listed) {
            INFO(word);
            // Vectors and masks but no fused products, which would round once instead of twice.
            const bool vector =
                (word[0] == 'v' && !word.starts_with("vfm") && !word.starts_with("vfnm")) || word[0] == 'k';
            REQUIRE((vector || plain.count(word) == 1));
            returns += word == "ret";
        }
        CHECK(returns == codes);
        CHECK(codes > 100);
    }
}

#endif
