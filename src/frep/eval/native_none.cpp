// native_code.h without asmjit (CMake option FREP_JIT): there is no native code.
#include "frep/eval/native_code.h"

#if !defined(FREP_HAS_JIT)

namespace frep {

template <class Real>
struct NativeCode<Real>::Program {
    NativeStatistics statistics;
};

template <class Real>
NativeCode<Real>::NativeCode(std::unique_ptr<Program> program) : program_(std::move(program)) {}
template <class Real>
NativeCode<Real>::NativeCode(NativeCode&&) noexcept = default;
template <class Real>
NativeCode<Real>& NativeCode<Real>::operator=(NativeCode&&) noexcept = default;
template <class Real>
NativeCode<Real>::~NativeCode() = default;

template <class Real>
bool NativeCode<Real>::is_available() {
    return false;
}
template <class Real>
std::optional<NativeCode<Real>> NativeCode<Real>::compile(const ClauseTape&, const NativeOptions&) {
    return std::nullopt;
}
template <class Real>
void NativeCode<Real>::run(const Real* const*, std::size_t, Real*) const {}
template <class Real>
void NativeCode<Real>::run(const NativeGrid<Real>&) const {}
template <class Real>
const NativeStatistics& NativeCode<Real>::statistics() const {
    return program_->statistics;
}
template <class Real>
std::span<const std::uint8_t> NativeCode<Real>::bytes() const {
    return {};
}

template <class Real>
bool native_code_pays(const ClauseTape&, std::size_t) {
    return false;
}

template class NativeCode<double>;
template class NativeCode<float>;
template bool native_code_pays<double>(const ClauseTape&, std::size_t);
template bool native_code_pays<float>(const ClauseTape&, std::size_t);

}  // namespace frep

#endif
