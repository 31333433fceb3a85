// The inner loop of BatchVm for AVX2 (cmake/isa.cmake). Tested by tests/unit/eval/batch_vm_test.cpp.
#if defined(__AVX2__)
#include "frep/eval/batch_loops.h"

namespace frep::batch {

Code<double> doubles_avx2() { return code<double, 32>(); }
Code<float> floats_avx2() { return code<float, 32>(); }

}  // namespace frep::batch
#else
#include "frep/eval/batch_frame.h"

namespace frep::batch {

Code<double> doubles_avx2() { return {0, nullptr, nullptr}; }
Code<float> floats_avx2() { return {0, nullptr, nullptr}; }

}  // namespace frep::batch
#endif
