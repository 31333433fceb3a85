# Files for one instruction set: NAME_avx2.cpp and NAME_avx512.cpp are compiled for it and run only where the
# machine has it (src/frep/eval/isa.h). On other processors than x86-64 they are empty. tools/check_isa checks
# that they leave no function behind that plain code could call by mistake.
function(frep_isa_flags)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    return()
  endif()
  foreach(source ${ARGN})
    if(source MATCHES "_avx2\\.cpp$")
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-mavx2")
    elseif(source MATCHES "_avx512\\.cpp$")
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS
                                  "-mavx512f;-mavx512dq;-mavx512vl;-mavx512bw;-mprefer-vector-width=512")
    endif()
  endforeach()
endfunction()
