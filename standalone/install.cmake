# What `cmake --install` puts in place: the program, the static library, its headers, and what
# `find_package(solidem)` reads. A project then links to solidem::solidem.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/solidem)

install(TARGETS solidem_core EXPORT solidem ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET solidem)
  install(TARGETS solidem RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES ${SOLIDEM_MANUAL} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${SOLIDEM_COMPLETION} RENAME solidem
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/solidem
  FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE)
install(EXPORT solidem NAMESPACE solidem:: FILE solidemTargets.cmake DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/solidemConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/solidemConfig.cmake
  ${PROJECT_BINARY_DIR}/solidemConfigVersion.cmake DESTINATION ${package})
