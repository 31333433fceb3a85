// From a clause tape to a list of steps: every operation that has a kernel of straight code is expanded by it
// (native_lanes.h); the others are calls of their meaning. Private to the native engine. Tested by
// tests/unit/eval/native_code_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "frep/eval/clause_tape.h"
#include "frep/eval/native_steps.h"
#include "frep/math/interval.h"

namespace frep::native {

/// What a call needs: the clause and its data.
struct CallContext {
    Op op = Op::constant;
    std::uint32_t operands = 0;
    std::uint32_t lanes = 0;
    std::span<const double> block;
};

struct Translation {
    StepList list;
    std::vector<ValueId> coordinates;  ///< input k stands for coordinate k
    std::vector<CallContext> calls;
    ValueId root = no_value;
};

/// `wide`: for AVX-512. `domain`: a range for each coordinate where the code will be run, or nothing: then
/// any number, and NaN.
Translation translate(const ClauseTape& tape, bool single, bool wide, std::span<const math::Interval> domain);

/// The helpers that native code calls (native_writer.h).
void patch_doubles_1(const void* function, unsigned mask, void* block);
void patch_doubles_2(const void* function, unsigned mask, void* block);
void patch_floats_1(const void* function, unsigned mask, void* block);
void patch_floats_2(const void* function, unsigned mask, void* block);
void call_on_doubles(const void* context, void* block);
void call_on_floats(const void* context, void* block);

}  // namespace frep::native
