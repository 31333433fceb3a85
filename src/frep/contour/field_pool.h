// The pool of evaluators of eval, under the name that contouring uses.
#pragma once

#include "frep/eval/field_pool.h"

namespace frep::contouring {
using frep::FieldPool;
}  // namespace frep::contouring
