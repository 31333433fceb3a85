// The loops of ColumnMarch compiled for sse2 (cmake/isa.cmake); see march_impl.h.
#include "frep/trace/march_impl.h"

namespace frep::march::sse2 {

const Kernels<float>& floats() { return float_table; }
const Kernels<double>& doubles() { return double_table; }

}  // namespace frep::march::sse2
