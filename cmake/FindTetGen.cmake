# Finds TetGen as a shared library: TETGEN_INCLUDE_DIR, TETGEN_LIBRARY, and TETGEN_SONAME, the name to load it by.
# No target: see components.cmake.
find_path(TETGEN_INCLUDE_DIR tetgen.h)
find_library(TETGEN_LIBRARY NAMES libtet.so libtetgen.so tet tetgen)
mark_as_advanced(TETGEN_INCLUDE_DIR TETGEN_LIBRARY)

set(TETGEN_SONAME "${TETGEN_LIBRARY}")
if(TETGEN_LIBRARY AND CMAKE_READELF)
  execute_process(COMMAND ${CMAKE_READELF} -d ${TETGEN_LIBRARY} OUTPUT_VARIABLE TETGEN_DYNAMIC ERROR_QUIET)
  if(TETGEN_DYNAMIC MATCHES "soname: \\[([^]]+)\\]")
    set(TETGEN_SONAME "${CMAKE_MATCH_1}")
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TetGen REQUIRED_VARS TETGEN_LIBRARY TETGEN_INCLUDE_DIR)
