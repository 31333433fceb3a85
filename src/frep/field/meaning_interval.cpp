#include "frep/field/meaning_impl.h"

template math::Interval frep::meaning<math::Interval>(frep::Op, std::span<const math::Interval>, std::span<const double>);
