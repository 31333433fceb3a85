// The vm over math::Dual<frep::math::Lanes>.
#include "frep/eval/vm_impl.h"

template class frep::Interpreter<frep::math::Dual<frep::math::Lanes>>;
template class frep::Machine<frep::math::Dual<frep::math::Lanes>>;
