// The passes of the pruner compiled for sse2 (cmake/isa.cmake); see tile_impl.h.
#include "frep/eval/tile_impl.h"

namespace frep::tile::sse2 {

const Kernels& kernels() { return table; }

}  // namespace frep::tile::sse2
