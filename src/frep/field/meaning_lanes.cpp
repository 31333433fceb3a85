#include "frep/field/meaning_impl.h"

template math::Lanes frep::meaning<math::Lanes>(frep::Op, std::span<const math::Lanes>, std::span<const double>);
