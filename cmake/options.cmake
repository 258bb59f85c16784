# Everything but the header-only target defaults to "am I the top-level project".
option(PAVIOR_BUILD_MATH "Compile the small solvers once for float and double" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_IO "Mesh formats (VTK, Gmsh)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_CAD "CAD model, surface quads, integer program (Gmsh, GLPK)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_CLI "The program pavior (needs IO and CAD)" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_TESTS "Tests" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_EXAMPLES "Examples" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_BUILD_BENCH "Benchmarks" OFF)
option(PAVIOR_INSTALL "Install rules" ${PROJECT_IS_TOP_LEVEL})
option(PAVIOR_WARNINGS_AS_ERRORS "Our own CI: every warning is an error" OFF)

add_library(pavior_warnings INTERFACE)
target_compile_options(pavior_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                                 $<$<BOOL:${PAVIOR_WARNINGS_AS_ERRORS}>:-Werror>)
