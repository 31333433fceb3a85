// The vm over math::Interval.
#include "frep/eval/vm_impl.h"

template class frep::Interpreter<frep::math::Interval>;
template class frep::Machine<frep::math::Interval>;
