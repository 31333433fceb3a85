// The functions that have a kernel of binary32 (math/single/functions.h). The interpreter and the translator
// of that profile must agree on them (docs/numerics.md, rule 14). Tested by
// tests/unit/eval/native_code_test.cpp.
#pragma once

#include "frep/field/op.h"

namespace frep {

constexpr bool has_single_function(Op op) {
    return op == Op::exp || op == Op::log || op == Op::sin || op == Op::cos || op == Op::atan ||
           op == Op::atan2;
}

}  // namespace frep
