// The passes of tile_kernels.h; included by one file for each instruction set. Tested by
// tests/unit/eval/prune_test.cpp.
#pragma once

#include "frep/eval/tile_forward.h"
#include "frep/eval/tile_reverse.h"

namespace frep::tile {
namespace {

constexpr Kernels table{forward, reverse, agree};

}  // namespace
}  // namespace frep::tile
