# Everything but the header-only target defaults to "am I the top-level project".
option(PAVIOR_BUILD_COMPILED "Compile all that is no template once; off: headers alone" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_IO "Mesh formats (VTK, Gmsh)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_CAD "CAD model, surface quads (Gmsh)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_GLPK "Integer programs (GLPK)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_TETRA "Tetrahedra in closed surfaces (TetGen, CGAL)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_IMPRINT "Curves in a plane cut by each other (CGAL)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_PART "CAD file to mesh in one call (needs IO, CAD, GLPK, TETRA and IMPRINT)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_CLI "The program pavior (needs all of these but COMPILED)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_TESTS "Tests" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_EXAMPLES "Examples" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_BENCH "Benchmarks" OFF)
option(PAVIOR_BUILD_FUZZ "Programs of libFuzzer (clang; needs IO, CAD, GLPK and IMPRINT)" OFF)
option(PAVIOR_ASSERTIONS "Assertions in the compiled library whatever the build type: our own tests" OFF)
option(PAVIOR_INSTALL "Install rules" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_WARNINGS_AS_ERRORS "Our own CI: warnings on, and every one an error" OFF)

if(PAVIOR_BUILD_PART AND NOT (PAVIOR_BUILD_IO AND PAVIOR_BUILD_CAD AND PAVIOR_BUILD_GLPK AND PAVIOR_BUILD_TETRA
                              AND PAVIOR_BUILD_IMPRINT))
  message(FATAL_ERROR "PAVIOR_BUILD_PART needs PAVIOR_BUILD_IO, _CAD, _GLPK, _TETRA and _IMPRINT")
endif()
if(PAVIOR_BUILD_CLI AND NOT PAVIOR_BUILD_PART)
  message(FATAL_ERROR "PAVIOR_BUILD_CLI needs PAVIOR_BUILD_PART")
endif()

# Flags of our own sources, never of those who use pavior.
set(PAVIOR_WARNING_FLAGS -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
add_library(pavior_warnings INTERFACE)
if(PAVIOR_WARNINGS_AS_ERRORS)
  # -Wrestrict of GCC 12 at -O3 sees overlaps in "text" + std::string that are not there (GCC bug 105651).
  target_compile_options(pavior_warnings INTERFACE ${PAVIOR_WARNING_FLAGS}
                                                   $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endif()
