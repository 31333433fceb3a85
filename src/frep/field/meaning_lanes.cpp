#include "frep/field/meaning_impl.h"

template frep::math::Lanes frep::meaning<frep::math::Lanes>(frep::Op, std::span<const frep::math::Lanes>,
                                                            std::span<const double>);
