#include "frep/field/meaning_impl.h"

template frep::math::Interval frep::meaning<frep::math::Interval>(frep::Op,
                                                                  std::span<const frep::math::Interval>,
                                                                  std::span<const double>);
