#include "frep/field/meaning_impl.h"

template math::Dual<math::Lanes> frep::meaning<math::Dual<math::Lanes>>(frep::Op, std::span<const math::Dual<math::Lanes>>, std::span<const double>);
