#include "frep/field/meaning_impl.h"

template frep::math::Dual<frep::math::Lanes> frep::meaning<frep::math::Dual<frep::math::Lanes>>(
    frep::Op, std::span<const frep::math::Dual<frep::math::Lanes>>, std::span<const double>);
