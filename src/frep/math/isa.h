// The namespace of the module: frep::math for the baseline build, and an inline namespace inside it where a
// file is compiled for a wider instruction set, so that no inline function built with AVX can replace its
// baseline twin at link time (numerics.md, rule 2). Checked by tests/unit/math/lanes_test.cpp.
// A program that uses such a namespace also compiles kernels.cpp and trig_reduce.cpp for that instruction
// set.
#pragma once

#if defined(__AVX512F__)
#define FREP_MATH_OPEN     \
    namespace frep::math { \
    inline namespace isa_avx512 {
#define FREP_MATH_CLOSE \
    }                   \
    }
#elif defined(__AVX2__)
#define FREP_MATH_OPEN     \
    namespace frep::math { \
    inline namespace isa_avx2 {
#define FREP_MATH_CLOSE \
    }                   \
    }
#else
/// Opens namespace frep::math (see above).
#define FREP_MATH_OPEN namespace frep::math {
/// Closes namespace frep::math.
#define FREP_MATH_CLOSE }
#endif
