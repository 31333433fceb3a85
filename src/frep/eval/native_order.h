// The order in which steps are written. A long chain of dependent steps fills the queues of the processor and
// keeps it from reaching the next chain; so chains are interleaved. Method: list scheduling over a window of
// the given order, on a simple machine (a few steps a cycle, a latency each), while registers last. The order
// changes no result. Private to the native engine. Tested by tests/unit/eval/native_steps_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "frep/eval/native_steps.h"

namespace frep::native {

/// `steps` (numbers of steps, operands before users) in the order to be written. `vectors` and `masks`:
/// values that may live at one time; masks 0: masks are vectors.
std::vector<ValueId> interleaved(const StepList& list, const std::vector<ValueId>& steps,
                                 std::uint32_t vectors, std::uint32_t masks);

}  // namespace frep::native
