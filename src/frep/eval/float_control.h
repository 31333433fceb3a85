// The floating-point environment that the numeric rules ask for (docs/numerics.md, rule 2): round to nearest,
// denormals kept, traps masked. Method: read MXCSR on entry, set it only when a caller changed it, put it
// back on exit. Tested by tests/unit/eval/conformance_test.cpp.
#pragma once

namespace frep {

/// While it lives, the calling thread computes under the rules of the project.
class FloatControl {
  public:
    FloatControl();
    ~FloatControl();
    FloatControl(const FloatControl&) = delete;
    FloatControl& operator=(const FloatControl&) = delete;

  private:
    unsigned saved_ = 0;
    bool changed_ = false;
};

}  // namespace frep
