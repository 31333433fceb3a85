// The passes of the pruner compiled for avx512 (cmake/isa.cmake); see tile_impl.h.
#include "frep/eval/tile_impl.h"

namespace frep::tile::avx512 {

const Kernels& kernels() { return table; }

}  // namespace frep::tile::avx512
