# Wide code keeps its functions to itself.
add_test(NAME check_isa COMMAND ${PROJECT_SOURCE_DIR}/tools/check_isa ${PROJECT_BINARY_DIR})
