# Compiled, optional targets: pavior::compiled, pavior::io, pavior::cad, pavior::glpk, pavior::tetra, pavior::imprint,
# pavior::part and the program.

# pavior_component(name): the static library pavior_<name> of src/<name>/*.cpp, with the alias pavior::<name>.
function(pavior_component name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(pavior_${name} STATIC ${sources} ${ARGN})
  add_library(pavior::${name} ALIAS pavior_${name})
  set_target_properties(pavior_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(pavior_${name} PUBLIC pavior PRIVATE $<BUILD_INTERFACE:pavior_warnings>)
  if(TARGET pavior_compiled AND NOT name STREQUAL compiled)
    target_link_libraries(pavior_${name} PUBLIC pavior_compiled) # all units of a program agree on the switch
  endif()
endfunction()

# All bodies that stand in -inl.hpp files, once: one source a header, several of them a translation unit.
if(PAVIOR_BUILD_COMPILED)
  file(GLOB_RECURSE bodies RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/include/pavior/*-inl.hpp)
  set(units "")
  foreach(header IN LISTS bodies)
    string(REGEX REPLACE "^pavior/(.*)-inl\\.hpp$" "compiled/\\1.cpp" unit ${header})
    file(CONFIGURE OUTPUT ${unit} CONTENT "#include <@header@>\n" @ONLY)
    list(APPEND units ${CMAKE_CURRENT_BINARY_DIR}/${unit})
  endforeach()
  pavior_component(compiled ${units})
  target_compile_definitions(pavior_compiled PUBLIC PAVIOR_COMPILED)
  target_compile_options(pavior_compiled PRIVATE $<$<BOOL:${PAVIOR_ASSERTIONS}>:-UNDEBUG>)
  file(GLOB instances src/compiled/*.cpp)
  list(FILTER units INCLUDE REGEX "/compiled/part/") # whole methods on AnyModel: up to 1.2 GB each
  set_source_files_properties(${instances} ${units} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_target_properties(pavior_compiled PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
endif()

list(PREPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)
if(PAVIOR_BUILD_IO OR PAVIOR_BUILD_CAD)
  find_package(Gmsh REQUIRED MODULE)
endif()

if(PAVIOR_BUILD_IO)
  enable_language(C) # VTK's package looks for C libraries such as MPI
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOXML IOLegacy)
  pavior_component(io)
  find_package(nlohmann_json REQUIRED)
  target_link_libraries(pavior_io PRIVATE Gmsh::Gmsh $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> VTK::CommonCore
                                          VTK::CommonDataModel VTK::IOXML VTK::IOLegacy)
endif()

if(PAVIOR_BUILD_CAD)
  pavior_component(cad)
  target_link_libraries(pavior_cad PRIVATE Gmsh::Gmsh)
endif()

if(PAVIOR_BUILD_GLPK)
  find_package(GLPK REQUIRED MODULE)
  pavior_component(glpk)
  target_link_libraries(pavior_glpk PRIVATE GLPK::GLPK)
endif()

if(PAVIOR_BUILD_TETRA)
  find_package(TetGen REQUIRED MODULE)
  set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
  find_package(CGAL 5.5 REQUIRED)
  pavior_component(tetra)
  # TetGen is loaded when it is needed, never linked: its symbols are those of the TetGen within Gmsh.
  target_include_directories(pavior_tetra SYSTEM PRIVATE ${TETGEN_INCLUDE_DIR})
  target_link_libraries(pavior_tetra PRIVATE CGAL::CGAL ${CMAKE_DL_LIBS})
  target_compile_definitions(pavior_tetra PRIVATE TETLIBRARY PAVIOR_TETGEN_SONAME="${TETGEN_SONAME}"
                                                  PAVIOR_TETGEN_LIBRARY="${TETGEN_LIBRARY}")
  target_compile_definitions(pavior_tetra PRIVATE CGAL_NDEBUG) # the same outcome in every build
endif()

if(PAVIOR_BUILD_IMPRINT)
  set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
  find_package(CGAL 5.5 REQUIRED)
  pavior_component(imprint)
  target_link_libraries(pavior_imprint PRIVATE CGAL::CGAL)
endif()

if(PAVIOR_BUILD_PART)
  find_package(nlohmann_json REQUIRED)
  file(GLOB reports CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/report/*.cpp)
  pavior_component(part ${reports})
  target_link_libraries(pavior_part PUBLIC pavior_io pavior_cad pavior_glpk pavior_tetra pavior_imprint
                                    PRIVATE $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
endif()

if(PAVIOR_BUILD_CLI)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  # All but main() in a library, so that tests reach it.
  file(GLOB sources CONFIGURE_DEPENDS src/cli/*.cpp)
  list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/src/cli/main.cpp)
  add_library(pavior_commands STATIC ${sources})
  target_include_directories(pavior_commands PUBLIC src)
  target_link_libraries(pavior_commands PUBLIC pavior_part CLI11::CLI11
                                               nlohmann_json::nlohmann_json
                                        PRIVATE pavior_warnings)
  add_executable(pavior_cli src/cli/main.cpp)
  set_target_properties(pavior_cli PROPERTIES OUTPUT_NAME pavior RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(pavior_cli PRIVATE pavior_commands pavior_warnings)
  set_source_files_properties(src/cli/main.cpp PROPERTIES COMPILE_DEFINITIONS PAVIOR_VERSION="${PROJECT_VERSION}")
endif()
