// The rules of jets, an operation each. Used by jet.cpp. Tested by tests/unit/measure/jet_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "frep/measure/jet.h"

namespace frep::measuring {

/// `op` on jets; `value` is its range. Nothing for an operation without a rule. `with_second` false: second
/// derivatives are left out.
std::optional<Jet> jet_of(Op op, const math::Interval& value, std::span<const Jet* const> operands,
                          bool with_second);

/// Nothing is known but the value and the variables.
Jet unknown_jet(const math::Interval& value, std::uint8_t moves);

}  // namespace frep::measuring
