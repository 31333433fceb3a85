// Implementation of block_arena.h.
#include "frep/contour/block_arena.h"

#include <cstdlib>
#include <new>

#include "frep/base/large_pages.h"

namespace frep::contouring {

void BlockArena::Free::operator()(std::byte* piece) const { std::free(piece); }

void* BlockArena::do_allocate(std::size_t bytes, std::size_t alignment) {
    const std::lock_guard lock(mutex_);
    const auto take = [&]() -> void* {
        auto left = static_cast<std::size_t>(end_ - next_);
        void* at = next_;
        if (!next_ || !std::align(alignment, bytes, at, left)) return nullptr;
        next_ = static_cast<std::byte*>(at) + bytes;
        return at;
    };
    if (void* at = take()) return at;
    const std::size_t unit = pieces_.size() < small_pieces ? small : large;
    const std::size_t size = (bytes + alignment + unit - 1) / unit * unit;
    auto* piece = static_cast<std::byte*>(std::aligned_alloc(unit, size));
    if (!piece) throw std::bad_alloc();
    pieces_.emplace_back(piece);
    if (unit == large) expect_to_fill(piece, size);
    next_ = piece;
    end_ = piece + size;
    return take();
}

}  // namespace frep::contouring
