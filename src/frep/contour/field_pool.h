// The pool of evaluators for worker threads (eval/field_pool.h) under this module's name.
#pragma once

#include "frep/eval/field_pool.h"

namespace frep::contouring {

using frep::FieldPool;

}  // namespace frep::contouring
