// The inner loop of BatchVm for AVX-512 (cmake/isa.cmake). Tested by tests/unit/eval/batch_vm_test.cpp.
#if defined(__AVX512F__)
#include "frep/eval/batch_loops.h"

namespace frep::batch {

Code<double> doubles_avx512() { return code<double, 64>(); }
Code<float> floats_avx512() { return code<float, 64>(); }

}  // namespace frep::batch
#else
#include "frep/eval/batch_frame.h"

namespace frep::batch {

Code<double> doubles_avx512() { return {0, nullptr, nullptr}; }
Code<float> floats_avx512() { return {0, nullptr, nullptr}; }

}  // namespace frep::batch
#endif
