// The inner loop of BatchVm: one switch a clause, one loop over the elements a case, made from the op table
// with the kernels of the field module over lanes. Included by batch_sse2.cpp, batch_avx2.cpp and
// batch_avx512.cpp only, each compiled for its instruction set; no function of std is called here, and all
// that stands in no template over a lane type has internal linkage. Tested by
// tests/unit/eval/batch_vm_test.cpp, tools/check_isa.
#pragma once

#include "frep/eval/batch_frame.h"
#include "frep/field/kernels/all.h"

namespace frep::batch {
namespace {

template <class T>
struct Element;
/// N numbers.
template <class E, int N>
struct Element<math::LanesOf<E, N>> {
    using T = math::LanesOf<E, N>;
    using Real = E;
    static constexpr std::size_t numbers = N;
    static T load(const Real* at) { return T::load(at); }
    static void store(const T& value, Real* at) { value.store(at); }
};
/// N values, then their derivatives in three directions.
template <class E, int N>
struct Element<math::Dual<math::LanesOf<E, N>>> {
    using Part = math::LanesOf<E, N>;
    using T = math::Dual<Part>;
    using Real = E;
    static constexpr std::size_t numbers = 4 * N;
    static T load(const Real* at) {
        T value(Part::load(at));
        value.d = {Part::load(at + N), Part::load(at + 2 * N), Part::load(at + 3 * N)};
        return value;
    }
    static void store(const T& value, Real* at) {
        value.value.store(at);
        const auto& [x, y, z] = value.d;
        x.store(at + N);
        y.store(at + 2 * N);
        z.store(at + 3 * N);
    }
};

/// An operand: `mask` 0 keeps it at its first element.
template <class Real>
struct Source {
    const Real* at;
    std::size_t mask;
};

template <class Real>
inline __attribute__((always_inline)) Source<Real> source(const Rows<Real>& rows, RowNumber row) {
    const bool value = row >= rows.first_value;
    const Real* const leaf = rows.leaves[value ? 0 : row];
    const Real* const computed = rows.values + static_cast<std::size_t>(row - rows.first_value) * rows.stride;
    return {value ? computed : leaf, row < rows.constants ? std::size_t{0} : ~std::size_t{0}};
}

template <int arity, class T, class Kernel, class Real>
inline __attribute__((always_inline)) void loop(Kernel kernel, const Rows<Real>& rows, const RowNumber* in,
                                                Real* out, std::size_t numbers) {
    using E = Element<T>;
    static_assert(arity >= 1 && arity <= 3);
    const Source<Real> a = source(rows, in[0]);
    const Source<Real> b = arity > 1 ? source(rows, in[1]) : a;
    const Source<Real> c = arity > 2 ? source(rows, in[2]) : a;
    for (std::size_t i = 0; i < numbers; i += E::numbers) {
        const auto item = [i](const Source<Real>& from) { return E::load(from.at + (i & from.mask)); };
        if constexpr (arity == 1) {
            E::store(kernel(item(a)), out + i);
        } else if constexpr (arity == 2) {
            E::store(kernel(item(a), item(b)), out + i);
        } else {
            E::store(kernel(item(a), item(b), item(c)), out + i);
        }
    }
}

/// Operations that have a loop: the cheap ones of the op table, and the functions that module math has for
/// this format (functions of binary32: math/single/functions.h).
template <class Real>
constexpr bool has_loop(Op op, int arity, int cost) {
    if (arity > 3) return false;
    if (cost <= 5) return true;
    switch (op) {
        case Op::exp:
        case Op::log:
        case Op::sin:
        case Op::cos:
        case Op::log10:
        case Op::tan:
        case Op::asin:
        case Op::acos:
        case Op::atan:
        case Op::atan2:
        case Op::sinh:
        case Op::cosh:
        case Op::tanh:
        case Op::remainder:
        case Op::pow:
            return sizeof(Real) == sizeof(double);
        default:
            return false;
    }
}

/// Runs the clauses of a frame over elements T.
template <class T>
void run(const Frame<typename Element<T>::Real>& frame) {
    using Real = typename Element<T>::Real;
    const Rows<Real> rows = frame.rows;
    const std::size_t numbers = frame.numbers;
    for (std::size_t i = 0; i < frame.clause_count; ++i) {
        const Clause& clause = frame.clauses[i];
        RowNumber in[3];
        __builtin_memcpy(in, &clause.in, sizeof(in));
        Real* out = rows.values + static_cast<std::size_t>(clause.out - rows.first_value) * rows.stride;
        if (i + 1 == frame.clause_count && frame.last_out) out = frame.last_out;
        switch (clause.op) {
#define FREP_LOOP_leaf(name, arity, cost)
#define FREP_LOOP_block(name, arity, cost)
#define FREP_LOOP_plain(name, arity, cost)                                                                \
    case Op::name:                                                                                        \
        if constexpr (has_loop<Real>(Op::name, arity, cost)) {                                            \
            loop<arity, T>([](const auto&... v) { return kernels::name(v...); }, rows, in, out, numbers); \
            continue;                                                                                     \
        }                                                                                                 \
        break;
#define FREP_OP(name, kind, arity, cost, context, doc) FREP_LOOP_##kind(name, arity, cost)
#include "frep/field/ops.def"
#undef FREP_OP
#undef FREP_LOOP_leaf
#undef FREP_LOOP_block
#undef FREP_LOOP_plain
            default:
                break;
        }
        frame.other(frame.owner, clause, out);
    }
}

/// The code for lanes of `bytes` bytes.
template <class Real, int bytes>
constexpr Code<Real> code() {
    constexpr int lanes = bytes / static_cast<int>(sizeof(Real));
    using Lanes = math::LanesOf<Real, lanes>;
    return {lanes, &run<Lanes>, &run<math::Dual<Lanes>>};
}

}  // namespace
}  // namespace frep::batch
