# Native code (src/frep/eval/native_*.cpp) needs asmjit (Debian: libasmjit-dev) and an x86-64 processor; without
# them everything builds and NativeCode::is_available() is false.
option(FREP_JIT "native code by asmjit where it is found (x86-64 only)" ON)
set(FREP_HAS_JIT OFF)
if(FREP_JIT AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  find_package(asmjit CONFIG QUIET)
  if(TARGET asmjit::asmjit)
    set(FREP_HAS_JIT ON)
    target_link_libraries(frep_eval PRIVATE asmjit::asmjit)
    target_compile_definitions(frep_eval PRIVATE FREP_HAS_JIT)
  endif()
endif()
message(STATUS "native code: ${FREP_HAS_JIT}")
