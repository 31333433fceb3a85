// The instruction sets that batch code is compiled for, and the choice among them at run time. The choice
// never changes a result (docs/numerics.md, rule 2), only the speed. Tested by tests/unit/eval/isa_test.cpp.
#pragma once

namespace frep {

/// In increasing order of width. sse2 is the baseline of x86-64 and stands for plain code on other machines.
enum class Isa {
    sse2,    ///< 16 bytes a register
    avx2,    ///< 32 bytes
    avx512,  ///< 64 bytes: F, DQ, VL and BW
};

/// The best set that this machine has and the limit allows.
Isa machine_isa();

/// Lets nothing wider than `limit` be chosen from now on, in the whole process; for tests and comparisons.
/// Objects that have chosen already keep their choice.
void set_isa_limit(Isa limit);

/// "sse2", "avx2" or "avx512".
const char* name_of(Isa isa);

}  // namespace frep
