# cmake -D source=<file> -D "compile=<compiler;flags>" -P check_compile_fail.cmake
# The file must compile as it is and must not compile with -DMISUSE; then the diagnostics must contain the text of its
# comment "// expect: <text>", which names the concept or assertion that is to catch the misuse. Names of files and quoted
# source lines do not count.
cmake_minimum_required(VERSION 3.25)

file(STRINGS ${source} expected REGEX "^// expect: ")
list(LENGTH expected count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "${source}: one comment '// expect: <text>' wanted, ${count} found")
endif()
string(REPLACE "// expect: " "" expected "${expected}")

execute_process(COMMAND ${compile} -fsyntax-only ${source} RESULT_VARIABLE result ERROR_VARIABLE diagnostics)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the correct twin does not compile\n${diagnostics}")
endif()

execute_process(COMMAND ${compile} -fsyntax-only -DMISUSE ${source} RESULT_VARIABLE result ERROR_VARIABLE diagnostics)
if(result EQUAL 0)
  message(FATAL_ERROR "the misuse compiles")
endif()
string(REGEX REPLACE "[^ \n]*\\.(cpp|hpp)" "" messages "${diagnostics}")
string(REGEX REPLACE "\n +[0-9]* +\\|[^\n]*" "" messages "${messages}")
string(FIND "${messages}" "${expected}" at)
if(at EQUAL -1)
  message(FATAL_ERROR "the misuse fails to compile, but not because of '${expected}'\n${diagnostics}")
endif()
