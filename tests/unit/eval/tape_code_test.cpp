// Code of tapes: the same bits before and after machine code takes over; equal tapes have one code.
#include "frep/eval/tape_code.h"

#include <doctest/doctest.h>

#include "unit/eval/blobs.h"
#include "unit/eval/engines.h"

using namespace frep;
using frep_test::blobs;
using frep_test::Random;

TEST_CASE("values are those of the interpreter, before and after compiling") {
    for (const int terms : {2, 30}) {
        const auto tape = make_clause_tape(blobs(2, terms));
        REQUIRE(tape);
        TapeCode code(*tape);
        BatchVm<double> vm, other;
        Random random(3);
        const std::size_t count = 1003;
        std::array<std::vector<double>, 3> columns;
        std::array<const double*, 3> at{};
        std::vector<double> expected(count), values(count);
        CHECK(!code.is_native());
        for (int round = 0; round < 40; ++round) {
            for (std::size_t i = 0; i < 3; ++i) {
                columns[i].resize(count);
                for (double& x : columns[i]) x = random.real(-1, 1);
                at[i] = columns[i].data();
            }
            other.values(*tape, at, count, expected.data());
            code.values(vm, at, count, values.data());
            CHECK(values == expected);
        }
        CHECK(code.is_native() == NativeCode<double>::is_available());
    }
}

TEST_CASE("equal tapes share their code") {
    const auto tape = make_clause_tape(blobs(2, 5));
    REQUIRE(tape);
    TapeCodes codes;
    const auto code = codes.code_for(*tape);
    CHECK(codes.code_for(*tape) == code);
    ClauseTape other = *tape;
    other.clauses.pop_back();
    other.root = other.clauses.back().out;
    CHECK(codes.code_for(other) != code);
    CHECK(codes.code_for(other)->tape().root == other.root);
    // the same clauses over other constants
    const auto elsewhere = make_clause_tape(blobs(9, 5));
    CHECK(codes.code_for(*elsewhere) != code);
}
