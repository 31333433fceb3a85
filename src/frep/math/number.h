// Everything that generic code over the number types double, Lanes, Interval and Dual needs.
// Checked by all of tests/unit/math.
#pragma once

#include "frep/math/dual.h"
#include "frep/math/functions.h"
#include "frep/math/interval.h"
#include "frep/math/rfunctions.h"
#include "frep/math/single/functions.h"
#include "frep/math/vec.h"
