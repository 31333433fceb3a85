// Implementation of native_translate.h.
#include "frep/eval/native_translate.h"
#include "frep/eval/single_functions.h"

#include "frep/eval/native_lanes.h"
// after the lane type, whose functions the kernels look up
#include "frep/field/kernels/all.h"
#include "frep/field/meaning.h"

namespace frep::native {
namespace {

template <class Real>
using T = math::EmitLanes<Real>;

/// Operations whose kernels decide by values, or visit lane by lane.
template <class Real>
constexpr bool is_straight(Op op, int arity, int cost) {
    // In binary32: the loops of BatchVm<float> (batch_loops.h).
    if (sizeof(Real) == sizeof(float) && !has_single_function(op)) return arity <= 3 && cost <= 5;
    switch (op) {
        case Op::sardf_int:
        case Op::ellipsoid_distance:
        case Op::sawtooth:
        case Op::lattice_noise:
        case Op::turbulence:
            return false;
        default:
            return true;
    }
}

template <int arity, class Kernel, class Lanes>
Lanes call_kernel(Kernel kernel, const Lanes* a) {
    if constexpr (arity == 1) return kernel(a[0]);
    if constexpr (arity == 2) return kernel(a[0], a[1]);
    if constexpr (arity == 3) return kernel(a[0], a[1], a[2]);
    if constexpr (arity == 4) return kernel(a[0], a[1], a[2], a[3]);
    if constexpr (arity == 5) return kernel(a[0], a[1], a[2], a[3], a[4]);
    if constexpr (arity == 6) return kernel(a[0], a[1], a[2], a[3], a[4], a[5]);
    if constexpr (arity == 7) return kernel(a[0], a[1], a[2], a[3], a[4], a[5], a[6]);
}

/// The value of a plain operation, or nothing when it must be called.
template <class Real>
ValueId expand(Op op, const T<Real>* a) {
    switch (op) {
#define FREP_CASE_leaf(name, arity, cost)
#define FREP_CASE_block(name, arity, cost)
#define FREP_CASE_plain(name, arity, cost)                                                  \
    case Op::name:                                                                          \
        if constexpr (is_straight<Real>(Op::name, arity, cost))                             \
            return call_kernel<arity>([](auto... v) { return kernels::name(v...); }, a).id; \
        return no_value;
#define FREP_OP(name, kind, arity, cost, context, doc) FREP_CASE_##kind(name, arity, cost)
#include "frep/field/ops.def"
#undef FREP_OP
#undef FREP_CASE_leaf
#undef FREP_CASE_block
#undef FREP_CASE_plain
        default:
            return no_value;
    }
}

/// What is known of functions that bit patterns hide.
void refine_result(StepList& list, Op op, ValueId r, const Facts& a) {
    Facts known;
    switch (op) {
        case Op::sin:
        case Op::cos:
            known.lo = -1.001;
            known.hi = 1.001;
            known.nan = a.nan || !a.finite();
            break;
        case Op::exp:
            known.lo = 0;
            known.nan = a.nan;
            known.minus_zero = false;
            break;
        default:
            return;
    }
    if (list.is_constant(r)) return;
    list.refine(r, known);
}

template <class Real>
class Translator {
  public:
    Translator(const ClauseTape& tape, Translation& out, std::uint32_t lanes)
        : tape_(tape), out_(out), lanes_(lanes), value_of_(tape.rows, no_value) {}

    void run(std::span<const math::Interval> domain) {
        const Recording recording(out_.list);
        const ClauseData& data = *tape_.data;
        for (std::size_t i = 0; i < data.constants.size(); ++i)
            value_of_[i] = out_.list.constant(data.constants[i]);
        for (int i = 0; i < data.coordinates; ++i) {
            Facts facts;
            if (!domain.empty()) {
                const auto& range = domain[static_cast<std::size_t>(i)];
                facts = {static_cast<Real>(range.lo), static_cast<Real>(range.hi), false, true, true};
                facts.plus_zero = facts.minus_zero = facts.lo <= 0 && facts.hi >= 0;
            }
            const ValueId v = out_.list.input(static_cast<std::uint32_t>(i), facts);
            out_.coordinates.push_back(v);
            value_of_[data.coordinate_row(i)] = v;
        }
        for (const Clause& clause : tape_.clauses) value_of_[clause.out] = value_of(clause);
        out_.root = value_of_[tape_.root];
    }

  private:
    ValueId value_of(const Clause& clause) {
        arguments_.clear();
        for (const RowNumber row : tape_.operands_of(clause))
            arguments_.push_back(T<Real>::of(value_of_[row]));
        if (info(clause.op).kind == OpKind::plain) {
            const Facts first = out_.list.facts(arguments_[0].id);
            const ValueId made = expand<Real>(clause.op, arguments_.data());
            if (made != no_value) {
                refine_result(out_.list, clause.op, made, first);
                return made;
            }
        }
        out_.calls.push_back({clause.op, clause.count, lanes_, tape_.block_of(clause)});
        ids_.clear();
        for (const auto& a : arguments_) ids_.push_back(a.id);
        return out_.list.call(static_cast<std::uint32_t>(out_.calls.size() - 1), ids_);
    }

    const ClauseTape& tape_;
    Translation& out_;
    std::uint32_t lanes_;
    std::vector<ValueId> value_of_;  ///< by row
    std::vector<T<Real>> arguments_;
    std::vector<ValueId> ids_;
};

template <class Real>
void patch_1(const void* function, unsigned mask, void* block, int lanes) {
    const auto f = reinterpret_cast<Real (*)(Real)>(reinterpret_cast<std::uintptr_t>(function));
    for (int i = 0; i < lanes; ++i) {
        if ((mask >> i & 1) == 0) continue;
        Real* const r = static_cast<Real*>(block);
        const Real* const x = reinterpret_cast<const Real*>(static_cast<const char*>(block) + 64);
        r[i] = f(x[i]);
    }
}
template <class Real>
void patch_2(const void* function, unsigned mask, void* block, int lanes) {
    const auto f = reinterpret_cast<Real (*)(Real, Real)>(reinterpret_cast<std::uintptr_t>(function));
    for (int i = 0; i < lanes; ++i) {
        if ((mask >> i & 1) == 0) continue;
        Real* const r = static_cast<Real*>(block);
        const Real* const x = reinterpret_cast<const Real*>(static_cast<const char*>(block) + 64);
        const Real* const y = reinterpret_cast<const Real*>(static_cast<const char*>(block) + 128);
        r[i] = f(x[i], y[i]);
    }
}

}  // namespace

void patch_doubles_1(const void* f, unsigned mask, void* block) { patch_1<double>(f, mask, block, 8); }
void patch_doubles_2(const void* f, unsigned mask, void* block) { patch_2<double>(f, mask, block, 8); }
void patch_floats_1(const void* f, unsigned mask, void* block) { patch_1<float>(f, mask, block, 16); }
void patch_floats_2(const void* f, unsigned mask, void* block) { patch_2<float>(f, mask, block, 16); }

namespace {

/// Operand k stands at 64 k bytes. Numbers of binary32 are widened and the result is rounded once, as in
/// batch_other.h.
template <class Real>
void call_meaning(const CallContext& call, Real* block) {
    constexpr std::uint32_t width = math::Lanes::size, apart = 64 / sizeof(Real);
    std::vector<math::Lanes> arguments(call.operands);
    for (std::uint32_t first = 0; first < call.lanes; first += width) {
        for (std::uint32_t k = 0; k < call.operands; ++k)
            for (std::uint32_t i = 0; i < width; ++i)
                arguments[k].set(static_cast<int>(i), block[k * apart + first + i]);
        const math::Lanes r = meaning<math::Lanes>(call.op, arguments, call.block);
        for (std::uint32_t i = 0; i < width; ++i)
            block[first + i] = static_cast<Real>(r[static_cast<int>(i)]);
    }
}

}  // namespace

void call_on_doubles(const void* context, void* block) {
    call_meaning(*static_cast<const CallContext*>(context), static_cast<double*>(block));
}
void call_on_floats(const void* context, void* block) {
    call_meaning(*static_cast<const CallContext*>(context), static_cast<float*>(block));
}

Translation translate(const ClauseTape& tape, bool single, bool wide,
                      std::span<const math::Interval> domain) {
    Translation made{StepList(single, wide), {}, {}, no_value};
    const std::uint32_t lanes = (wide ? 64 : 32) / (single ? 4 : 8);
    if (single) {
        Translator<float>(tape, made, lanes).run(domain);
    } else {
        Translator<double>(tape, made, lanes).run(domain);
    }
    return made;
}

}  // namespace frep::native
