#include "frep/eval/isa.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace frep;

TEST_CASE("isa: the limit holds, and is undone") {
    const Isa best = machine_isa();
    set_isa_limit(Isa::avx2);
    CHECK(machine_isa() <= Isa::avx2);
    set_isa_limit(Isa::sse2);
    CHECK(machine_isa() == Isa::sse2);
    set_isa_limit(Isa::avx512);
    CHECK(machine_isa() == best);
}

TEST_CASE("isa: names") {
    CHECK(std::strcmp(name_of(Isa::sse2), "sse2") == 0);
    CHECK(std::strcmp(name_of(Isa::avx2), "avx2") == 0);
    CHECK(std::strcmp(name_of(Isa::avx512), "avx512") == 0);
}
