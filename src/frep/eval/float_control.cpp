// Setting and restoring MXCSR; see float_control.h. Other processors than x86-64 start every thread in the
// state the rules ask for and are left alone.
#include "frep/eval/float_control.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace frep {

#if defined(__SSE2__)

namespace {
constexpr unsigned sticky_flags = 0x003f;  // exceptions that happened: no setting
constexpr unsigned required = 0x1f80;      // all traps masked, nearest, no FTZ, no DAZ
}  // namespace

FloatControl::FloatControl() : saved_(_mm_getcsr()) {
    changed_ = (saved_ & ~sticky_flags) != required;
    if (changed_) _mm_setcsr(required);
}

FloatControl::~FloatControl() {
    if (changed_) _mm_setcsr(saved_);
}

#else

FloatControl::FloatControl() = default;
FloatControl::~FloatControl() = default;

#endif

}  // namespace frep
