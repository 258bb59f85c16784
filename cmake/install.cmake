# The package: headers, the libraries that were built (one export set each, so that a consumer of one needs the
# dependencies of that one alone), and a config file that finds those dependencies.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pavior)

install(DIRECTORY include/pavior DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
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
