include(${CMAKE_CURRENT_LIST_DIR}/isa.cmake)

# frep_module(NAME DEPENDS ...): the static library frep_NAME from src/frep/NAME/*.cpp.
# A new source file needs no line here.
function(frep_module name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/frep/${name}/*.cpp)
  frep_isa_flags(${sources})
  add_library(frep_${name} STATIC ${sources})
  frep_library_settings(frep_${name} ${arg_DEPENDS})
endfunction()

# frep_facade(NAME DEPENDS ...): the facade library, the one that consumers link (frep::frep).
function(frep_facade name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/frep/*.cpp)
  add_library(${name} STATIC ${sources})
  frep_library_settings(${name} ${arg_DEPENDS})
  add_library(frep::frep ALIAS ${name})
endfunction()

function(frep_library_settings target)
  target_link_libraries(${target} PUBLIC frep_settings ${ARGN})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON LINKER_LANGUAGE CXX)
  set_property(GLOBAL APPEND PROPERTY FREP_INSTALL_TARGETS ${target})
endfunction()
