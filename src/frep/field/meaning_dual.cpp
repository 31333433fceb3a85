#include "frep/field/meaning_impl.h"

template frep::math::Dual<double> frep::meaning<frep::math::Dual<double>>(
    frep::Op, std::span<const frep::math::Dual<double>>, std::span<const double>);
