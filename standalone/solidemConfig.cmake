# find_package(solidem): the target solidem::solidem and all that the static library stands on.
include(CMakeFindDependencyMacro)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(Eigen3 NO_MODULE)
find_dependency(fmt)
find_dependency(nlohmann_json)
find_dependency(PkgConfig)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
include(${CMAKE_CURRENT_LIST_DIR}/solidemTargets.cmake)
