// The engine jit: the vm, with values of F by native code once so many points have been asked for that
// compiling pays (native_code_pays). The count is that of all clones together, which share the code. Never
// more than about twice the work of the better of the two. Tested by tests/unit/eval/jit_evaluator_test.cpp.
#pragma once

#include <memory>

#include "frep/base/result.h"
#include "frep/eval/evaluator.h"

namespace frep {

/// True where this build and this machine have the engine.
bool has_jit();

/// The jit engine for `field`; the vm itself where there is no native code for it (has_jit(), regions, very
/// long tapes). Errors: as of make_vm.
Result<std::unique_ptr<Evaluator>> make_jit(const Field& field, const EvaluatorOptions& options);

}  // namespace frep
