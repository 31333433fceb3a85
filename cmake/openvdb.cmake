# OpenVDB files (src/frep/io/read_vdb.cpp) need libopenvdb (Debian: libopenvdb-dev, libboost-dev); without it everything builds
# and such files are refused with a message. Plain names are linked: an installed frep asks for nothing more.
option(FREP_OPENVDB "read OpenVDB files where libopenvdb is found" ON)
set(FREP_HAS_OPENVDB OFF)
if(FREP_OPENVDB)
  find_path(FREP_OPENVDB_INCLUDE openvdb/openvdb.h)
  find_path(FREP_OPENVDB_BOOST boost/version.hpp)  # its headers include Boost's; Debian does not say so
  find_library(FREP_OPENVDB_LIBRARY openvdb)
  find_library(FREP_OPENVDB_TBB tbb)
  mark_as_advanced(FREP_OPENVDB_INCLUDE FREP_OPENVDB_BOOST FREP_OPENVDB_LIBRARY FREP_OPENVDB_TBB)
  if(FREP_OPENVDB_INCLUDE AND FREP_OPENVDB_BOOST AND FREP_OPENVDB_LIBRARY AND FREP_OPENVDB_TBB)
    set(FREP_HAS_OPENVDB ON)
    target_link_libraries(frep_io PRIVATE openvdb tbb)
    target_compile_definitions(frep_io PRIVATE FREP_HAS_OPENVDB)
    # TBB's hash map, which OpenVDB uses, marks nodes by odd addresses: no finding about our code
    set(FREP_OPENVDB_OPTIONS -fno-sanitize=alignment)
    set_source_files_properties(src/frep/io/read_vdb.cpp PROPERTIES COMPILE_OPTIONS "${FREP_OPENVDB_OPTIONS}")
  endif()
endif()
message(STATUS "OpenVDB: ${FREP_HAS_OPENVDB}")
