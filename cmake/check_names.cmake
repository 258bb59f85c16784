# cmake -P check_names.cmake: fails on names that break the conventions of CONTRIBUTING.md. clang-tidy reads all public
# headers as one unit with the rules of .clang-tidy; concepts, which clang-tidy 14 does not see, are searched for here.
cmake_minimum_required(VERSION 3.25)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)

file(GLOB_RECURSE headers RELATIVE ${root}/include ${root}/include/pavior/*.hpp)
set(all "")
set(bad "")
foreach(header IN LISTS headers)
  if(NOT header STREQUAL "pavior/mesh/cgal_access.hpp")
    string(APPEND all "#include <${header}>\n")
  endif()
  file(STRINGS ${root}/include/${header} concepts REGEX "^ *concept +[A-Za-z_0-9]+")
  foreach(concept IN LISTS concepts)
    if(NOT concept MATCHES "^ *concept +[a-z][a-z_0-9]* ")
      string(APPEND bad "${header}: ${concept}\n")
    endif()
  endforeach()
endforeach()
if(bad)
  message(FATAL_ERROR "concepts are named in snake_case:\n${bad}")
endif()

set(unit ${root}/build/names/all.cpp)
file(CONFIGURE OUTPUT ${unit} CONTENT "@all@" @ONLY)
execute_process(COMMAND clang-tidy-14 --quiet --config-file=${root}/.clang-tidy ${unit} --
                        -std=c++20 -I${root}/include -isystem /usr/include/eigen3
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_QUIET)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "names:\n${output}")
endif()
