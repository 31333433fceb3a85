# Build options and the compile settings that every target of the project shares.
option(FREP_BUILD_APPS "build the command frep" ON)
option(FREP_BUILD_TESTS "build the tests" ${PROJECT_IS_TOP_LEVEL})
option(FREP_BUILD_BENCH "build the benchmark programs" OFF)
option(FREP_BUILD_FUZZERS "build the libFuzzer targets (clang only)" OFF)
option(FREP_INSTALL "generate install rules" ${PROJECT_IS_TOP_LEVEL})
option(FREP_WERROR "treat warnings as errors" OFF)
set(FREP_PARALLEL "tbb" CACHE STRING "back end of base/parallel: tbb or threads")
set(FREP_SANITIZE "" CACHE STRING "sanitizers, for instance address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "build type" FORCE)
endif()

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
if(FREP_PARALLEL STREQUAL "tbb")
  find_package(TBB REQUIRED)
endif()

# Arithmetic is fixed by the numeric rules (docs/numerics.md): no contraction into FMA,
# no fast-math, no global -march. errno and floating-point traps are not observed, which
# changes no result and lets square roots and selections run in wide lanes.
add_library(frep_settings INTERFACE)
target_compile_features(frep_settings INTERFACE cxx_std_20)
target_compile_options(frep_settings INTERFACE
  -ffp-contract=off $<BUILD_INTERFACE:-fno-math-errno>
  $<BUILD_INTERFACE:-fno-trapping-math>
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wpedantic>
  $<BUILD_INTERFACE:-Wshadow> $<BUILD_INTERFACE:-Wnon-virtual-dtor>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>>)
# g++ 12 warns of string and vector code of its own library where it inlines it (GCC bugs 105329, 105651).
target_compile_options(frep_settings INTERFACE
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-aggressive-loop-optimizations>>)
if(FREP_WERROR)
  target_compile_options(frep_settings INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(FREP_SANITIZE)
  target_compile_options(frep_settings INTERFACE
    -fsanitize=${FREP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(frep_settings INTERFACE -fsanitize=${FREP_SANITIZE})
endif()
if(FREP_BUILD_FUZZERS)
  target_compile_options(frep_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
