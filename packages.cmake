# `cpack -G DEB` in the build makes Debian packages, one for each component of what is installed. That
# of the module is made where it is built (SOLIDEM_PYTHON), that of LIGGGHTS where Debian's LIGGGHTS is.
include(GNUInstallDirs)
set(CPACK_PACKAGE_VENDOR "The solidem developers")
set(CPACK_PACKAGE_CONTACT "The solidem developers <solidem@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # libraries that the files in a package load

# package(NAME DESCRIPTION [DEPENDS ...] [RECOMMENDS ...]): a component of this name.
function(package name description)
  cmake_parse_arguments(PARSE_ARGV 2 given "" "" "DEPENDS;RECOMMENDS")
  list(JOIN given_DEPENDS ", " depends)
  list(JOIN given_RECOMMENDS ", " recommends)
  string(TOUPPER ${name} component)
  set(CPACK_DEBIAN_${component}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${component}_DESCRIPTION ${description} PARENT_SCOPE)
  set(CPACK_DEBIAN_${component}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${component}_PACKAGE_RECOMMENDS "${recommends}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${name} PARENT_SCOPE)
  install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT ${name} EXCLUDE_FROM_ALL)
endfunction()

package(solidem "Continuous solids as compact packings of spheres: program and manual"
  RECOMMENDS python3-solidem)
# A static library: what it stands on is linked with it.
package(libsolidem-dev "Continuous solids as compact packings of spheres: library and headers"
  DEPENDS g++ libeigen3-dev libfmt-dev libhdf5-dev libssl-dev libtomlplusplus-dev libudunits2-dev
          nlohmann-json3-dev pkg-config voro++-dev
  RECOMMENDS cmake)
if(SOLIDEM_PYTHON)
  package(python3-solidem "Continuous solids as compact packings of spheres: Python module"
    DEPENDS ${SOLIDEM_PYTHON_NEEDED} python3-numpy
    RECOMMENDS python3-h5py python3-matplotlib python3-pandas)
endif()
if(IS_DIRECTORY /usr/include/liggghts)
  package(liggghts-solidem "Continuous solids as compact packings of spheres: styles of LIGGGHTS"
    RECOMMENDS liggghts openmpi-bin python3-numpy)
  # Built when it is installed; the styles' sources stand to the laws and scripts as they do here.
  set(gathered ${PROJECT_BINARY_DIR}/liggghts)
  install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DTO=${gathered}
    -P ${PROJECT_SOURCE_DIR}/contrib/liggghts/gather_prebuilt.cmake COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL)
  install(DIRECTORY ${gathered}/ DESTINATION . USE_SOURCE_PERMISSIONS
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL)
  set(sources ${CMAKE_INSTALL_DATADIR}/solidem)
  install(DIRECTORY contrib/liggghts DESTINATION ${sources}/contrib USE_SOURCE_PERMISSIONS
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL PATTERN "*.cmake" EXCLUDE PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY contrib/liggghts/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liggghts-solidem
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL
    FILES_MATCHING PATTERN "*.md" PATTERN "doc/*.txt")
  install(FILES contrib/prepared.py contrib/explained.py DESTINATION ${sources}/contrib
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL)
  install(DIRECTORY standalone/laws DESTINATION ${sources}/standalone
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL)
  install(FILES standalone/effects/kernels/pack.hpp
    DESTINATION ${sources}/standalone/effects/kernels
    COMPONENT liggghts-solidem EXCLUDE_FROM_ALL)
endif()
include(CPack)
