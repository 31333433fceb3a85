# Files compiled for a wider instruction set than the rest: NAME_avx2.cpp and NAME_avx512.cpp of the modules.
# They keep to bare pointers and internal linkage, so that no function of theirs can serve the baseline
# (docs/numerics.md, rule 2), and are entered only where the machine has the set (eval/isa.h).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
  file(GLOB isa_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/frep/*/*_avx2.cpp)
  set_source_files_properties(${isa_sources} PROPERTIES COMPILE_OPTIONS "-mavx2")
  file(GLOB isa_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/frep/*/*_avx512.cpp)
  set_source_files_properties(${isa_sources} PROPERTIES
    COMPILE_OPTIONS "-mavx512f;-mavx512dq;-mavx512vl;-mavx512bw;-mprefer-vector-width=512")
endif()
