// EmitLanes<Real>: the lane type that emits instructions. A kernel called with it computes nothing; its
// operations are appended to the list of steps that is being made on this thread, so that the native engine
// and the interpreters run the same formulas. Private to the native engine; include it before the kernels of
// module field. Tested by tests/unit/eval/native_code_test.cpp.
#pragma once

#include "frep/eval/native_steps.h"
#include "frep/math/hyperbolic.h"
#include "frep/math/inverse_trig.h"
#include "frep/math/power.h"
#include "frep/math/remainder.h"
#include "frep/math/rfunctions.h"
#include "frep/math/single/functions.h"
#include "frep/math/trig.h"

namespace frep::native {

/// The list that kernels append to.
inline thread_local StepList* current_list = nullptr;

/// Sets the list for a while.
class Recording {
  public:
    explicit Recording(StepList& list) : before_(current_list) { current_list = &list; }
    ~Recording() { current_list = before_; }
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

  private:
    StepList* before_;
};

}  // namespace frep::native

FREP_MATH_OPEN

/// Truth values that will be known when the code runs.
template <class Real>
struct EmitMask {
    native::ValueId id;

    friend EmitMask operator&(EmitMask a, EmitMask b) {
        return {native::current_list->make(native::StepOp::mask_and, a.id, b.id)};
    }
    friend EmitMask operator|(EmitMask a, EmitMask b) {
        return {native::current_list->make(native::StepOp::mask_or, a.id, b.id)};
    }
    friend EmitMask operator!(EmitMask a) { return {native::current_list->mask_not(a.id)}; }
};

/// The bits of numbers.
template <class Real>
struct EmitWords {
    native::ValueId id;

    static EmitWords of(std::uint64_t bits) { return {native::current_list->constant_bits(bits)}; }
    static EmitWords make(native::StepOp op, EmitWords a, EmitWords b) {
        return {native::current_list->make(op, a.id, b.id)};
    }
    friend EmitWords operator+(EmitWords a, EmitWords b) { return make(native::StepOp::word_add, a, b); }
    friend EmitWords operator-(EmitWords a, EmitWords b) { return make(native::StepOp::word_subtract, a, b); }
    friend EmitWords operator&(EmitWords a, EmitWords b) { return make(native::StepOp::bit_and, a, b); }
    friend EmitWords operator|(EmitWords a, EmitWords b) { return make(native::StepOp::bit_or, a, b); }
    friend EmitWords operator^(EmitWords a, EmitWords b) { return make(native::StepOp::bit_xor, a, b); }
    friend EmitWords operator+(EmitWords a, std::uint64_t b) { return a + of(b); }
    friend EmitWords operator-(EmitWords a, std::uint64_t b) { return a - of(b); }
    friend EmitWords operator&(EmitWords a, std::uint64_t b) { return a & of(b); }
    friend EmitWords operator|(EmitWords a, std::uint64_t b) { return a | of(b); }
    friend EmitWords operator<<(EmitWords a, int n) {
        return {native::current_list->make(native::StepOp::shift_left, a.id, native::no_value,
                                           static_cast<std::uint8_t>(n))};
    }
    friend EmitWords operator>>(EmitWords a, int n) {
        return {native::current_list->make(native::StepOp::shift_right, a.id, native::no_value,
                                           static_cast<std::uint8_t>(n))};
    }
    friend EmitMask<Real> mask_of_low_bit(EmitWords a) {
        return {native::current_list->make(native::StepOp::low_bit, a.id)};
    }
};

/// Numbers.
template <class Real>
struct EmitLanes {
    native::ValueId id = native::no_value;

    EmitLanes() = default;
    EmitLanes(double all) : id(native::current_list->constant(all)) {}
    explicit EmitLanes(EmitWords<Real> bits) : id(bits.id) {}
    static EmitLanes of(native::ValueId id) {
        EmitLanes r;
        r.id = id;
        return r;
    }
    static EmitLanes make(native::StepOp op, EmitLanes a, EmitLanes b) {
        return of(native::current_list->make(op, a.id, b.id));
    }

    friend EmitLanes operator+(EmitLanes a, EmitLanes b) { return make(native::StepOp::add, a, b); }
    friend EmitLanes operator-(EmitLanes a, EmitLanes b) { return make(native::StepOp::subtract, a, b); }
    friend EmitLanes operator*(EmitLanes a, EmitLanes b) { return make(native::StepOp::multiply, a, b); }
    friend EmitLanes operator/(EmitLanes a, EmitLanes b) { return make(native::StepOp::divide, a, b); }
    friend EmitLanes operator-(EmitLanes a) {
        native::StepList& list = *native::current_list;
        return of(list.make(native::StepOp::bit_xor, a.id, list.constant_bits(list.sign_bit())));
    }
    EmitLanes& operator+=(EmitLanes b) { return *this = *this + b; }
    EmitLanes& operator-=(EmitLanes b) { return *this = *this - b; }
    EmitLanes& operator*=(EmitLanes b) { return *this = *this * b; }
    EmitLanes& operator/=(EmitLanes b) { return *this = *this / b; }

    static EmitMask<Real> compare(native::Predicate p, EmitLanes a, EmitLanes b) {
        return {native::current_list->compare(p, a.id, b.id)};
    }
    friend EmitMask<Real> less(EmitLanes a, EmitLanes b) { return compare(native::Predicate::less, a, b); }
    friend EmitMask<Real> less_equal(EmitLanes a, EmitLanes b) {
        return compare(native::Predicate::less_equal, a, b);
    }
    friend EmitMask<Real> equal(EmitLanes a, EmitLanes b) { return compare(native::Predicate::equal, a, b); }
    friend EmitMask<Real> is_nan(EmitLanes a) { return compare(native::Predicate::unordered, a, a); }
    friend EmitLanes select(EmitMask<Real> m, EmitLanes a, EmitLanes b) {
        return of(native::current_list->choose(m.id, a.id, b.id));
    }
};

template <class Real>
struct MaskOf<EmitLanes<Real>> {
    using type = EmitMask<Real>;
};
template <class Real>
struct WordOf<EmitLanes<Real>> {
    using type = EmitWords<Real>;
};
template <class Real>
struct ItemOf<EmitLanes<Real>> {
    using type = Real;
};
template <>
inline constexpr bool is_lane_type<EmitLanes<double>> = true;
template <>
inline constexpr bool is_single_type<EmitLanes<float>> = true;

/// The friends under qualified names, as for LanesN.
template <class Real>
inline EmitMask<Real> less(EmitLanes<Real> a, EmitLanes<Real> b) {
    return less(a, b);
}
template <class Real>
inline EmitMask<Real> less_equal(EmitLanes<Real> a, EmitLanes<Real> b) {
    return less_equal(a, b);
}
template <class Real>
inline EmitMask<Real> equal(EmitLanes<Real> a, EmitLanes<Real> b) {
    return equal(a, b);
}
template <class Real>
inline EmitMask<Real> is_nan(EmitLanes<Real> a) {
    return is_nan(a);
}
template <class Real>
inline EmitLanes<Real> select(EmitMask<Real> m, EmitLanes<Real> a, EmitLanes<Real> b) {
    return select(m, a, b);
}
template <class Real>
inline EmitWords<Real> bits_of(EmitLanes<Real> x) {
    return {x.id};
}

/// Rare lanes by a call.
template <class Real, class F>
inline EmitLanes<Real> patch(EmitMask<Real> m, EmitLanes<Real> r, EmitLanes<Real> x, F f) {
    Real (*const function)(Real) = f;
    return EmitLanes<Real>::of(native::current_list->patch(m.id, r.id, x.id, native::no_value,
                                                           reinterpret_cast<const void*>(function)));
}
template <class Real, class F>
inline EmitLanes<Real> patch(EmitMask<Real> m, EmitLanes<Real> r, EmitLanes<Real> x, EmitLanes<Real> y, F f) {
    Real (*const function)(Real, Real) = f;
    return EmitLanes<Real>::of(
        native::current_list->patch(m.id, r.id, x.id, y.id, reinterpret_cast<const void*>(function)));
}

// What the machine does in one instruction with the bits of the formulas in rounding.h.
template <class Real>
inline EmitLanes<Real> sqrt(EmitLanes<Real> x) {
    return EmitLanes<Real>::of(native::current_list->make(native::StepOp::square_root, x.id));
}
template <class Real>
inline EmitLanes<Real> min(EmitLanes<Real> a, EmitLanes<Real> b) {
    return EmitLanes<Real>::of(native::current_list->minimum(a.id, b.id));
}
template <class Real>
inline EmitLanes<Real> max(EmitLanes<Real> a, EmitLanes<Real> b) {
    return EmitLanes<Real>::of(native::current_list->maximum(a.id, b.id));
}
template <class Real>
inline EmitLanes<Real> emit_rounding(EmitLanes<Real> x, native::Rounding how) {
    return EmitLanes<Real>::of(native::current_list->make(native::StepOp::round, x.id, native::no_value,
                                                          static_cast<std::uint8_t>(how)));
}
template <class Real>
inline EmitLanes<Real> trunc(EmitLanes<Real> x) {
    return emit_rounding(x, native::Rounding::to_zero);
}
template <class Real>
inline EmitLanes<Real> floor(EmitLanes<Real> x) {
    return emit_rounding(x, native::Rounding::down);
}
template <class Real>
inline EmitLanes<Real> ceil(EmitLanes<Real> x) {
    return emit_rounding(x, native::Rounding::up);
}
template <class Real>
inline EmitLanes<Real> abs(EmitLanes<Real> x) {
    return EmitLanes<Real>(bits_of(x) & (native::current_list->sign_bit() - 1));
}
template <class Real>
inline EmitLanes<Real> square(EmitLanes<Real> x) {
    return x * x;
}

// The functions of functions.h, expanded in place.
#define FREP_EMIT_UNARY(name) \
    inline EmitLanes<double> name(EmitLanes<double> x) { return kernel::name(x); }
FREP_EMIT_UNARY(exp)
FREP_EMIT_UNARY(log)
FREP_EMIT_UNARY(log10)
FREP_EMIT_UNARY(sin)
FREP_EMIT_UNARY(cos)
FREP_EMIT_UNARY(tan)
FREP_EMIT_UNARY(asin)
FREP_EMIT_UNARY(acos)
FREP_EMIT_UNARY(atan)
FREP_EMIT_UNARY(sinh)
FREP_EMIT_UNARY(cosh)
FREP_EMIT_UNARY(tanh)
#undef FREP_EMIT_UNARY
inline EmitLanes<double> atan2(EmitLanes<double> a, EmitLanes<double> b) { return kernel::atan2(a, b); }
inline EmitLanes<double> remainder_trunc(EmitLanes<double> a, EmitLanes<double> b) {
    return kernel::remainder_trunc(a, b);
}
/// The formula of kernels.cpp.
inline EmitLanes<double> hypot(EmitLanes<double> a, EmitLanes<double> b) {
    using T = EmitLanes<double>;
    const T x = abs(a), y = abs(b);
    const auto swap = less(x, y);
    const T big = select(swap, y, x);
    const T r = hypot_ordered(big, select(swap, x, y));
    const T value = select(equal(big, T(infinity)), T(infinity), r);
    return select(is_nan(a), a, select(is_nan(b), b, value));
}
/// A constant exponent decides now whether the chain is taken.
inline EmitLanes<double> pow(EmitLanes<double> b, EmitLanes<double> e) {
    using T = EmitLanes<double>;
    const native::StepList& list = *native::current_list;
    if (!list.is_constant(e.id))
        return patch(kernel::takes_chain(e), kernel::pow_general(b, e), b, e, kernel::pow_chain);
    const double exponent = list.number_of(e.id);
    if (!kernel::takes_chain(exponent)) return kernel::pow_general(b, e);
    const double n = kernel::snapped_exponent(exponent);
    return select(less(abs(b), T(kernel::power_snap)), T(kernel::power_of_zero(n)),
                  kernel::powi(b, static_cast<int>(n)));
}

FREP_MATH_CLOSE
