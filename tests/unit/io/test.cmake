# Pictures are read back with the library that wrote them.
target_link_libraries(test_io PRIVATE PNG::PNG)
