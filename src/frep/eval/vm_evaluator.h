// The Evaluator over the vm's machines: cuts calls into batches, pads the last one, seeds derivatives.
// Tested by tests/unit/eval/conformance_test.cpp.
#pragma once

#include <memory>

#include "frep/base/result.h"
#include "frep/eval/evaluator.h"

namespace frep {

/// The vm engine for `field`. Errors: over_limit.
Result<std::unique_ptr<Evaluator>> make_vm(const Field& field, const EvaluatorOptions& options);

}  // namespace frep
