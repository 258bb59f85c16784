# cmake -D root=<repository> -P check_test_map.cmake: every public header has its test file and every test file its
# subject. include/pavior/<room>/<stem>.hpp <-> tests/<room>/<stem>_test.cpp; a test file may also have its subject in
# src/<room>. Tests of a whole room end in _cases.cpp and need no subject.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/architecture.cmake)
set(gaps 0)

file(GLOB headers RELATIVE ${root}/include/pavior ${root}/include/pavior/*/*.hpp)
foreach(header IN LISTS headers)
  string(REGEX REPLACE "\\.hpp$" "_test.cpp" test ${header})
  if(NOT EXISTS ${root}/tests/${test})
    math(EXPR gaps "${gaps} + 1")
    message("include/pavior/${header} has no tests/${test}")
  endif()
endforeach()

foreach(room IN LISTS rooms source_rooms)
  file(GLOB tests RELATIVE ${root}/tests ${root}/tests/${room}/*_test.cpp)
  foreach(test IN LISTS tests)
    string(REGEX REPLACE "_test\\.cpp$" "" subject ${test})
    if(NOT EXISTS ${root}/include/pavior/${subject}.hpp AND NOT EXISTS ${root}/src/${subject}.hpp
       AND NOT EXISTS ${root}/src/${subject}.cpp)
      math(EXPR gaps "${gaps} + 1")
      message("tests/${test} tests no include/pavior/${subject}.hpp")
    endif()
  endforeach()
endforeach()

list(LENGTH headers header_count)
if(gaps)
  message(FATAL_ERROR "${gaps} gaps between headers and tests")
elseif(NOT headers)
  message(FATAL_ERROR "no headers under ${root}/include/pavior")
endif()
message("${header_count} headers have their tests")
