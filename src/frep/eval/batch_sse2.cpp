// The inner loop of BatchVm for the baseline; doubles go in fours, for which module math has its functions.
// Tested by tests/unit/eval/batch_vm_test.cpp.
#include "frep/eval/batch_loops.h"

namespace frep::batch {

Code<double> doubles_sse2() { return code<double, 32>(); }
Code<float> floats_sse2() { return code<float, 16>(); }

}  // namespace frep::batch
