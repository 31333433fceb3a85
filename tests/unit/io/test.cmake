# Pictures are read back with the library that wrote them.
target_link_libraries(test_io PRIVATE PNG::PNG)
# Zip archives are unpacked by zlib, the JSON of glTF is parsed.
target_link_libraries(test_io PRIVATE ZLIB::ZLIB nlohmann_json::nlohmann_json)
