// The vm over math::Lanes.
#include "frep/eval/vm_impl.h"

template class frep::Interpreter<frep::math::Lanes>;
template class frep::Machine<frep::math::Lanes>;
