# The tests run the real command; the text files are in tests/cli.
if(TARGET frep_cli)
  add_dependencies(test_cli frep_cli)
  target_compile_definitions(test_cli PRIVATE FREP_PROGRAM="$<TARGET_FILE:frep_cli>")
else()
  target_compile_definitions(test_cli PRIVATE FREP_PROGRAM="")
  set_tests_properties(test_cli PROPERTIES DISABLED TRUE)
endif()
