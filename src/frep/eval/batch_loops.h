// The inner loop of BatchVm: one switch a clause, one loop over the elements a case, made from the op table
// with the kernels of the field module over lanes. Included by batch_sse2.cpp, batch_avx2.cpp and
// batch_avx512.cpp only, each compiled for its instruction set; no function of std is called here, and all
// that stands in no template over a lane type has internal linkage. Tested by
// tests/unit/eval/batch_vm_test.cpp, tools/check_isa.
#pragma once

#include "frep/eval/batch_frame.h"
#include "frep/eval/single_functions.h"
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

/// An operand and its way to the next element: `step` 0 for a constant.
template <class Real>
struct Source {
    const Real* at;
    std::size_t step;
};
/// Two elements a turn, where an element is one register: that hides the latency of one behind the other.
/// (Written out, since with a lambda for an element g++ 12 keeps the operands in memory.)
template <int arity, class T, class Kernel, class Real>
inline __attribute__((always_inline)) void loop(Kernel kernel, Source<Real> a, Source<Real> b, Source<Real> c,
                                                Real* out, std::size_t numbers) {
    using E = Element<T>;
    static_assert(arity >= 1 && arity <= 3);
    Real* const end = out + numbers;
    const auto advance = [&](std::size_t elements) {
        a.at += elements * a.step;
        if constexpr (arity > 1) b.at += elements * b.step;
        if constexpr (arity > 2) c.at += elements * c.step;
    };
    if constexpr (sizeof(T) <= 64) {
        for (; out + E::numbers < end; out += 2 * E::numbers) {
            const T a0 = E::load(a.at), a1 = E::load(a.at + a.step);
            if constexpr (arity == 1) {
                E::store(kernel(a0), out);
                E::store(kernel(a1), out + E::numbers);
            } else {
                const T b0 = E::load(b.at), b1 = E::load(b.at + b.step);
                if constexpr (arity == 2) {
                    E::store(kernel(a0, b0), out);
                    E::store(kernel(a1, b1), out + E::numbers);
                } else {
                    const T c0 = E::load(c.at), c1 = E::load(c.at + c.step);
                    E::store(kernel(a0, b0, c0), out);
                    E::store(kernel(a1, b1, c1), out + E::numbers);
                }
            }
            advance(2);
        }
    }
    for (; out < end; out += E::numbers) {
        if constexpr (arity == 1) {
            E::store(kernel(E::load(a.at)), out);
        } else if constexpr (arity == 2) {
            E::store(kernel(E::load(a.at), E::load(b.at)), out);
        } else {
            E::store(kernel(E::load(a.at), E::load(b.at), E::load(c.at)), out);
        }
        advance(1);
    }
}

/// Operations that have a loop: the cheap ones of the op table, and the functions that module math has for
/// this format (functions of binary32: math/single/functions.h).
template <class Real>
constexpr bool has_loop(Op op, int arity, int cost) {
    if (arity > 3) return false;
    if (cost <= 5 || has_single_function(op)) return true;
    switch (op) {
        case Op::log10:
        case Op::tan:
        case Op::asin:
        case Op::acos:
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
    const Real* const* const rows = frame.rows;
    const RowNumber constants = frame.constants;
    const std::size_t numbers = frame.numbers;
    constexpr std::size_t step = Element<T>::numbers;
    for (std::size_t i = 0; i < frame.clause_count; ++i) {
        const Clause& clause = frame.clauses[i];
        Real* out = const_cast<Real*>(rows[clause.out]);
        if (i + 1 == frame.clause_count && frame.last_out) out = frame.last_out;
        if (clause.listed) {
            frame.other(frame.owner, clause, out);
            continue;
        }
        RowNumber in[3];  // row 0 where a clause has less operands
        __builtin_memcpy(in, &clause.in, sizeof(in));
        const Source<Real> a = {rows[in[0]], in[0] < constants ? 0 : step};
        const Source<Real> b = {rows[in[1]], in[1] < constants ? 0 : step};
        const Source<Real> c = {rows[in[2]], in[2] < constants ? 0 : step};
        switch (clause.op) {
#define FREP_LOOP_leaf(name, arity, cost)
#define FREP_LOOP_block(name, arity, cost)
#define FREP_LOOP_plain(name, arity, cost)                                                               \
    case Op::name:                                                                                       \
        if constexpr (has_loop<Real>(Op::name, arity, cost)) {                                           \
            loop<arity, T>([](const auto&... v) { return kernels::name(v...); }, a, b, c, out, numbers); \
            continue;                                                                                    \
        }                                                                                                \
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
