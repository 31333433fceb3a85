# Pictures are read back with the library that wrote them.
target_link_libraries(test_io PRIVATE PNG::PNG)
# Zip archives are unpacked by zlib, the JSON of glTF is parsed, and SVG.
target_link_libraries(test_io PRIVATE ZLIB::ZLIB nlohmann_json::nlohmann_json pugixml::pugixml)
# A font with composite glyphs (Debian: fonts-dejavu-core); the test is skipped without.
find_file(FREP_TEST_FONT DejaVuSans.ttf PATHS /usr/share/fonts PATH_SUFFIXES truetype/dejavu dejavu TTF)
target_compile_definitions(test_io PRIVATE FREP_TEST_FONT="${FREP_TEST_FONT}")
if(FREP_HAS_OPENVDB)
  target_link_libraries(test_io PRIVATE openvdb tbb)
  target_compile_definitions(test_io PRIVATE FREP_HAS_OPENVDB)
  set_source_files_properties(${folder}/read_vdb_test.cpp PROPERTIES COMPILE_OPTIONS "${FREP_OPENVDB_OPTIONS}")
endif()
