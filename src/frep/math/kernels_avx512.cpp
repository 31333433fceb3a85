// The kernels once more, compiled for AVX-512 (cmake/isa.cmake), in a namespace of their own (isa.h).
#if defined(__AVX512F__)
#include "frep/math/kernels.cpp"
#include "frep/math/trig_reduce.cpp"
#endif
