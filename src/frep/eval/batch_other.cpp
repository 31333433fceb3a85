// Implementation of batch_other.h.
#include "frep/eval/batch_other.h"

#include "frep/field/meaning.h"

namespace frep::batch {
namespace {

using math::Dual;
using math::Lanes;
constexpr std::size_t width = Lanes::size;

Lanes load(const double* at) { return Lanes::load(at); }
Lanes load(const float* at) {
    Lanes value;
    for (int i = 0; i < Lanes::size; ++i) value.set(i, static_cast<double>(at[i]));
    return value;
}
void store(Lanes value, double* at) { value.store(at); }
void store(Lanes value, float* at) {
    for (int i = 0; i < Lanes::size; ++i) at[i] = static_cast<float>(value[i]);
}
/// Derivatives stay finite.
void store_derivative(Lanes value, double* at) { value.store(at); }
void store_derivative(Lanes value, float* at) {
    constexpr double most = math::Format<float>::max_finite;
    store(math::min(math::max(value, Lanes(-most)), Lanes(most)), at);
}

}  // namespace

template <class Real>
void OtherOperations<Real>::values(const OtherCall<Real>& call) {
    const std::size_t count = call.operands.size();
    values_.resize(count);
    for (std::size_t i = 0; i < call.numbers; i += width) {
        // a constant operand is one element, all of whose lanes are alike
        for (std::size_t k = 0; k < count; ++k)
            values_[k] = load(call.operands[k].at + (i & call.operands[k].mask));
        store(meaning<Lanes>(call.op, values_, call.block), call.out + i);
    }
}

template <class Real>
void OtherOperations<Real>::gradients(const OtherCall<Real>& call) {
    const std::size_t count = call.operands.size(), lanes = call.lanes;
    duals_.resize(count);
    for (std::size_t element = 0; element < call.numbers; element += 4 * lanes) {
        for (std::size_t i = 0; i < lanes; i += width) {
            for (std::size_t k = 0; k < count; ++k) {
                const Real* at = call.operands[k].at + (element & call.operands[k].mask) + i;
                duals_[k].value = load(at);
                for (std::size_t j = 0; j < 3; ++j) duals_[k].d[j] = load(at + (j + 1) * lanes);
            }
            const auto r = meaning<Dual<Lanes>>(call.op, duals_, call.block);
            Real* to = call.out + element + i;
            store(r.value, to);
            for (std::size_t j = 0; j < 3; ++j) store_derivative(r.d[j], to + (j + 1) * lanes);
        }
    }
}

template class OtherOperations<double>;
template class OtherOperations<float>;

}  // namespace frep::batch
