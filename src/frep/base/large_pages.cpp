// Implementation of large_pages.h.
#include "frep/base/large_pages.h"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace frep {

void expect_to_fill([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    // The system takes the large pages that fit; the hint itself counts in small ones.
    constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
    if (bytes < page) return;
    const auto first = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t low = first / page * page, high = (first + bytes + page - 1) / page * page;
    madvise(reinterpret_cast<void*>(low), high - low, MADV_HUGEPAGE);
#endif
}

}  // namespace frep
