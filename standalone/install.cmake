# What `cmake --install` puts in place, by components as the packages have them (packages.cmake): the
# program with its manual and examples; the static library, its headers, and what
# `find_package(solidem)` reads. A project then links to solidem::solidem.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

if(TARGET solidem)
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/solidem)
  install(TARGETS solidem RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT solidem)
  install(FILES ${SOLIDEM_MANUAL} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT solidem)
  install(FILES ${SOLIDEM_COMPLETION} RENAME solidem
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT solidem)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${documents} COMPONENT solidem
    FILES_MATCHING PATTERN "*.md" PATTERN "*.toml" PATTERN "*.png" PATTERN "*.svg")
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/solidem)
install(TARGETS solidem_core EXPORT solidem
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libsolidem-dev)
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ COMPONENT libsolidem-dev
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/solidem FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE)
install(EXPORT solidem NAMESPACE solidem:: FILE solidemTargets.cmake DESTINATION ${package}
  COMPONENT libsolidem-dev)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/solidemConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/solidemConfig.cmake
  ${PROJECT_BINARY_DIR}/solidemConfigVersion.cmake DESTINATION ${package} COMPONENT libsolidem-dev)
