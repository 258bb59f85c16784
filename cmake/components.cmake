# Compiled, optional targets: pavior::math, pavior::io, pavior::cad and the program.

# pavior_component(name sources...): a static library pavior_<name> with the alias pavior::<name>.
function(pavior_component name)
  add_library(pavior_${name} STATIC ${ARGN})
  add_library(pavior::${name} ALIAS pavior_${name})
  set_target_properties(pavior_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(pavior_${name} PUBLIC pavior PRIVATE $<BUILD_INTERFACE:pavior_warnings>)
endfunction()

if(PAVIOR_BUILD_MATH)
  file(GLOB sources CONFIGURE_DEPENDS src/math/*.cpp)
  pavior_component(math ${sources})
  target_compile_definitions(pavior_math PUBLIC PAVIOR_COMPILED_MATH)
endif()

if(PAVIOR_BUILD_IO OR PAVIOR_BUILD_CAD)
  find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
  find_library(GMSH_LIBRARY gmsh REQUIRED)
  add_library(pavior_gmsh INTERFACE)
  target_include_directories(pavior_gmsh SYSTEM INTERFACE $<BUILD_INTERFACE:${GMSH_INCLUDE_DIR}>)
  target_link_libraries(pavior_gmsh INTERFACE ${GMSH_LIBRARY})
endif()

if(PAVIOR_BUILD_IO)
  # VTK's own CMake package of Debian 12 looks for C packages such as MPI.
  enable_language(C)
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOXML IOLegacy)
  file(GLOB sources CONFIGURE_DEPENDS src/io/*.cpp)
  pavior_component(io ${sources})
  target_link_libraries(pavior_io PRIVATE pavior_gmsh VTK::CommonCore VTK::CommonDataModel VTK::IOXML VTK::IOLegacy)
endif()

if(PAVIOR_BUILD_CAD)
  find_path(GLPK_INCLUDE_DIR glpk.h REQUIRED)
  find_library(GLPK_LIBRARY glpk REQUIRED)
  file(GLOB sources CONFIGURE_DEPENDS src/cad/*.cpp)
  pavior_component(cad ${sources})
  target_include_directories(pavior_cad SYSTEM PRIVATE ${GLPK_INCLUDE_DIR})
  target_link_libraries(pavior_cad PRIVATE pavior_gmsh ${GLPK_LIBRARY})
endif()

if(PAVIOR_BUILD_CLI)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  file(GLOB sources CONFIGURE_DEPENDS src/cli/*.cpp)
  add_executable(pavior_cli ${sources})
  set_target_properties(pavior_cli PROPERTIES OUTPUT_NAME pavior RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(pavior_cli PRIVATE pavior pavior_io pavior_cad CLI11::CLI11 nlohmann_json::nlohmann_json
                                           pavior_warnings)
endif()
