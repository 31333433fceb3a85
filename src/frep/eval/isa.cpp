// Method: CPUID and the state that the system saves, through the compiler's __builtin_cpu_supports.
#include "frep/eval/isa.h"

#include <algorithm>
#include <atomic>

namespace frep {
namespace {

std::atomic<Isa> limit{Isa::avx512};

Isa detect() {
#if defined(__x86_64__)
    __builtin_cpu_init();
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    if (wide) return Isa::avx512;
    if (__builtin_cpu_supports("avx2")) return Isa::avx2;
#endif
    return Isa::sse2;
}

}  // namespace

Isa machine_isa() {
    static const Isa best = detect();
    return std::min(best, limit.load(std::memory_order_relaxed));
}

void set_isa_limit(Isa isa) { limit.store(isa, std::memory_order_relaxed); }

const char* name_of(Isa isa) {
    switch (isa) {
        case Isa::sse2:
            return "sse2";
        case Isa::avx2:
            return "avx2";
        case Isa::avx512:
            return "avx512";
    }
    return "";
}

}  // namespace frep
