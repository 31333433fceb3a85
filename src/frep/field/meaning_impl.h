// Definition of meaning<T>; included by the files that instantiate it, one number type each.
#pragma once

#include "frep/field/kernels/all.h"
#include "frep/field/meaning.h"

namespace frep {
namespace detail {

template <int arity, class Kernel, class T>
T call_plain(Kernel kernel, const T* a) {
    if constexpr (arity == 1) return kernel(a[0]);
    if constexpr (arity == 2) return kernel(a[0], a[1]);
    if constexpr (arity == 3) return kernel(a[0], a[1], a[2]);
    if constexpr (arity == 4) return kernel(a[0], a[1], a[2], a[3]);
    if constexpr (arity == 5) return kernel(a[0], a[1], a[2], a[3], a[4]);
    if constexpr (arity == 6) return kernel(a[0], a[1], a[2], a[3], a[4], a[5]);
    if constexpr (arity == 7) return kernel(a[0], a[1], a[2], a[3], a[4], a[5], a[6]);
}

}  // namespace detail

template <class T>
T meaning(Op op, std::span<const T> arguments, std::span<const double> block) {
    const T* a = arguments.data();
    switch (op) {
#define FREP_CASE_leaf(name, arity) \
    case Op::name:                  \
        break;
#define FREP_CASE_plain(name, arity) \
    case Op::name:                   \
        return detail::call_plain<arity>([](auto... v) { return kernels::name(v...); }, a);
#define FREP_CASE_block(name, arity)                                                                \
    case Op::name:                                                                                  \
        return kernels::name(a, kernels::Data<T>(block.empty() ? nullptr : block.data(), a + arity, \
                                                 block.empty() ? arguments.size() - arity : block.size()));
#define FREP_OP(name, kind, arity, cost, context, doc) FREP_CASE_##kind(name, arity)
#include "frep/field/ops.def"
#undef FREP_OP
#undef FREP_CASE_leaf
#undef FREP_CASE_plain
#undef FREP_CASE_block
    }
    FREP_CHECK(false);
}

}  // namespace frep
