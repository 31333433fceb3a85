// Data<T>: the data items of an op of kind block, whether they are constants or values.
#pragma once

#include <cstddef>

#include "frep/math/number.h"

namespace frep::kernels {

template <class T>
class Data {
  public:
    Data(const double* block, const T* values, std::size_t count)
        : block_(block), values_(values), count_(count) {}
    std::size_t size() const { return count_; }
    /// True when every item is a constant of the model.
    bool is_constant() const { return block_ != nullptr; }
    /// All items of constant data.
    const double* block() const { return block_; }
    /// Item i of constant data.
    double number(std::size_t i) const { return block_[i]; }
    T operator[](std::size_t i) const { return block_ ? math::constant<T>(block_[i]) : values_[i]; }

  private:
    const double* block_;
    const T* values_;
    std::size_t count_;
};

}  // namespace frep::kernels
