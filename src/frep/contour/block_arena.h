// BlockArena: the memory of the blocks of one mesh, in large pieces that are all given back together at the
// end. Many threads may take from it. Tested by tests/unit/contour/block_arena_test.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace frep::contouring {

class BlockArena final : public std::pmr::memory_resource {
  public:
    BlockArena() = default;
    BlockArena(const BlockArena&) = delete;
    BlockArena& operator=(const BlockArena&) = delete;

  private:
    /// Pieces are as large as a large page (base/large_pages.h), the first few smaller.
    static constexpr std::size_t large = std::size_t{1} << 21, small = std::size_t{1} << 16, small_pieces = 8;

    struct Free {
        void operator()(std::byte* piece) const;
    };
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void*, std::size_t, std::size_t) override {}
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::mutex mutex_;
    std::vector<std::unique_ptr<std::byte, Free>> pieces_;
    std::byte* next_ = nullptr;  ///< free up to end_
    std::byte* end_ = nullptr;
};

}  // namespace frep::contouring
