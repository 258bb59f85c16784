# cmake -D program=<file> -D expected=<file> -P run_example.cmake
# The program must succeed, and print exactly what the expected file says where that file exists.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${program} ${arguments} RESULT_VARIABLE result OUTPUT_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${program} ended with ${result}\n${output}")
endif()
if(EXISTS ${expected})
  file(READ ${expected} wanted)
  if(NOT output STREQUAL wanted)
    message(FATAL_ERROR "${program} printed\n${output}\ninstead of ${expected}\n${wanted}")
  endif()
endif()
