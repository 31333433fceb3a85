# The ctest entry "consumer": installs the build into a fresh prefix, then configures, builds and runs
# tests/consumer against it. Needs no network.
# Variables: BINARY_DIR (of the project), SOURCE_DIR (this folder), WORK_DIR, COMPILER, GENERATOR, BUILD_TYPE.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
message(STATUS "${output}")

# The warnings of the project are its own affair.
file(READ ${WORK_DIR}/build/compile_commands.json commands)
if(commands MATCHES " -W(all|extra|error|pedantic|shadow)")
  message(FATAL_ERROR "the warning flags of the project reach its consumers:\n${commands}")
endif()
if(NOT EXISTS ${WORK_DIR}/ball.stl)
  message(FATAL_ERROR "the consumer wrote no mesh")
endif()
