# cmake -D "compile=<compiler;flags>" -D "units=<sources>" -D build=<folder> [-D flags=<flags>]
#       -P check_link_twice.cmake
# Compiles each unit and links it twice, as two units of the same text would be: a function that a header defines
# without inline is refused. -O0: what is inline and unused makes no code.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${build})
file(MAKE_DIRECTORY ${build})
list(REMOVE_ITEM compile "")
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${build} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message("${output}")
    message(FATAL_ERROR "${ARGN}")
  endif()
endfunction()

set(objects "")
foreach(unit IN LISTS units)
  get_filename_component(name ${unit} NAME_WE)
  run(${compile} ${flags} -O0 -c ${unit} -o ${name}.o)
  file(COPY_FILE ${build}/${name}.o ${build}/${name}_again.o)
  list(APPEND objects ${name}.o ${name}_again.o)
endforeach()
file(WRITE ${build}/main.cpp "int main() {}\n")
run(${compile} ${objects} main.cpp -pthread -o program)
run(${build}/program)
file(REMOVE_RECURSE ${build})
