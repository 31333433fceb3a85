#include "frep/field/meaning_impl.h"

template math::Dual<double> frep::meaning<math::Dual<double>>(frep::Op, std::span<const math::Dual<double>>, std::span<const double>);
