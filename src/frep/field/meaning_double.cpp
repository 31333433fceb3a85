#include "frep/field/meaning_impl.h"

template double frep::meaning<double>(frep::Op, std::span<const double>, std::span<const double>);
