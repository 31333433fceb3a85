// Implementation of membership.h.
#include "frep/measure/membership.h"

#include "frep/math/number.h"

namespace frep {

Membership membership(double value, std::span<const double> gradient, double tolerance) {
    if (value != value) return Membership::out;
    double slope = 0;
    for (const double partial : gradient) slope = math::hypot(slope, partial);
    if (value == 0 || math::abs(value) <= tolerance * slope) return Membership::on;
    return value > 0 ? Membership::in : Membership::out;
}

std::string_view to_string(Membership membership) {
    switch (membership) {
        case Membership::in:
            return "in";
        case Membership::on:
            return "on";
        case Membership::out:
            return "out";
    }
    return {};
}

}  // namespace frep
