// The functions of binary32: what numbers of type SinglesN have of their own beside the exact functions of
// rounding.h. All are templates over the lane type, straight-line, with select instead of branches and patch
// for rare lanes, so that a lane type that emits instructions expands the same code. Checked by
// tests/unit/math/single_functions_test.cpp and single_rfunctions_test.cpp.
#pragma once

#include "frep/math/single/exp_log.h"
#include "frep/math/single/inverse_trig.h"
#include "frep/math/single/rfunctions.h"
#include "frep/math/single/trig.h"
