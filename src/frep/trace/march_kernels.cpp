// The choice of the loops of march_kernels.h.
#include "frep/trace/march_kernels.h"

#include "frep/eval/isa.h"

namespace frep::march {

template <>
const Kernels<float>& kernels<float>() {
#if defined(__x86_64__)
    const Isa isa = machine_isa();
    if (isa != Isa::sse2) return isa == Isa::avx512 ? avx512::floats() : avx2::floats();
#endif
    return sse2::floats();
}
template <>
const Kernels<double>& kernels<double>() {
#if defined(__x86_64__)
    const Isa isa = machine_isa();
    if (isa != Isa::sse2) return isa == Isa::avx512 ? avx512::doubles() : avx2::doubles();
#endif
    return sse2::doubles();
}

}  // namespace frep::march
