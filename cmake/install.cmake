# The package: headers, the libraries that were built (one export set each, so that a consumer of one needs the
# dependencies of that one alone), and a config file that finds those dependencies.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pavior)

# Headers that declare what was not built stay behind.
include(${CMAKE_CURRENT_LIST_DIR}/architecture.cmake)
set(left_out "")
foreach(room IN LISTS compiled_rooms)
  if(NOT TARGET pavior_${room})
    list(APPEND left_out REGEX "include/pavior/${room}$" EXCLUDE)
  endif()
endforeach()
foreach(header IN LISTS compiled_headers)
  string(REGEX REPLACE "/.*" "" room ${header})
  if(NOT TARGET pavior_${room})
    list(APPEND left_out REGEX "include/pavior/${header}$" EXCLUDE)
  endif()
endforeach()
install(DIRECTORY include/pavior DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${left_out})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(TARGETS pavior EXPORT pavior-targets)
install(EXPORT pavior-targets NAMESPACE pavior:: DESTINATION ${package_dir})

foreach(component compiled io cad glpk tetra imprint part)
  if(TARGET pavior_${component})
    install(TARGETS pavior_${component} EXPORT pavior-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT pavior-${component} NAMESPACE pavior:: FILE pavior-${component}-targets.cmake
            DESTINATION ${package_dir})
  endif()
endforeach()
if(PAVIOR_BUILD_CLI)
  install(TARGETS pavior_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

configure_package_config_file(cmake/pavior-config.cmake.in ${PROJECT_BINARY_DIR}/pavior-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pavior-config-version.cmake COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/pavior-config.cmake ${PROJECT_BINARY_DIR}/pavior-config-version.cmake
              cmake/FindGmsh.cmake cmake/FindGLPK.cmake
        DESTINATION ${package_dir})

# For those who build without CMake: pkg-config --cflags --libs pavior, or pavior-compiled.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /${pc_dir} /)
set(pc_threads "")
if(Threads_FOUND)
  set(pc_threads -pthread)
endif()
configure_file(cmake/pavior.pc.in pavior.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/pavior.pc DESTINATION ${pc_dir})
if(TARGET pavior_compiled)
  configure_file(cmake/pavior-compiled.pc.in pavior-compiled.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pavior-compiled.pc DESTINATION ${pc_dir})
endif()
