# cmake -D source=<file> -D "compile=<compiler;flags>" -P check_compile_fail.cmake
# The file must compile as it is and must not compile with -DMISUSE; then the messages must match the regular expression
# of its comment "// expect: <regex>", which names the concept or assertion that is to catch the misuse. Names of files
# in the messages do not count, and the flags should keep the compiler from quoting source lines.
cmake_minimum_required(VERSION 3.25)

file(STRINGS ${source} expected REGEX "^// expect: ")
if(expected STREQUAL "")
  message(FATAL_ERROR "${source}: the comment '// expect: <regex>' is missing")
endif()
string(REPLACE "// expect: " "" expected "${expected}")

execute_process(COMMAND ${compile} -fsyntax-only ${source} RESULT_VARIABLE result ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the correct twin does not compile\n${messages}")
endif()

execute_process(COMMAND ${compile} -fsyntax-only -DMISUSE ${source} RESULT_VARIABLE result ERROR_VARIABLE messages)
if(result EQUAL 0)
  message(FATAL_ERROR "the misuse compiles")
endif()
string(REGEX REPLACE "[^ \n]*\\.[ch]pp" "" matched "${messages}")
if(NOT matched MATCHES "${expected}")
  message(FATAL_ERROR "the misuse fails to compile, but not because of '${expected}'\n${messages}")
endif()
