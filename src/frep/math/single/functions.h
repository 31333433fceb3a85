// The functions of binary32: what numbers of type SinglesN have of their own beside the exact functions of
// rounding.h. Checked by tests/unit/math/single_*_test.cpp.
#pragma once

#include "frep/math/single/rfunctions.h"
