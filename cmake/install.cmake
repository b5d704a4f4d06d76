# What an installed tetlod consists of: the library, its header, a CMake package and a pkg-config file. Every path in
# them is relative, so that the installed tree can be moved. The worker, the tool and the man pages install themselves.
# Components: library, development, tool, worker, python; each is a package (package.cmake). ParaView's plugin, in
# paraview_plugins, is in none.
include(CMakePackageConfigHelpers)

set(TETLOD_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tetlod)
set(TETLOD_PKGCONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS tetlod tetlod_static EXPORT tetlodTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/capi/tetlod.h ${PROJECT_SOURCE_DIR}/bindings/cpp/tetlod.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT development)
# What binaries have to bring with them; other packages depend on the library's.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${CMAKE_CURRENT_LIST_DIR}/NOTICES
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libtetlod${PROJECT_VERSION_MAJOR} COMPONENT library)
install(EXPORT tetlodTargets NAMESPACE tetlod:: DESTINATION ${TETLOD_CMAKE_DIR} COMPONENT development)
export(EXPORT tetlodTargets NAMESPACE tetlod:: FILE ${PROJECT_BINARY_DIR}/cmake/tetlodTargets.cmake)  # for the build tree

if(TARGET tetlod_fortran)
  install(TARGETS tetlod_fortran tetlod_fortran_static EXPORT tetlodFortranTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT tetlodFortranTargets NAMESPACE tetlod:: DESTINATION ${TETLOD_CMAKE_DIR} COMPONENT development)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tetlodConfig.cmake.in
  ${PROJECT_BINARY_DIR}/cmake/tetlodConfig.cmake
  INSTALL_DESTINATION ${TETLOD_CMAKE_DIR}
  NO_SET_AND_CHECK_MACRO)
# Functions are only added within a major version, so a newer minor one serves too.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/tetlodConfigVersion.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMajorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/cmake/tetlodConfig.cmake
  ${PROJECT_BINARY_DIR}/cmake/tetlodConfigVersion.cmake
  DESTINATION ${TETLOD_CMAKE_DIR} COMPONENT development)

# pkg-config knows the folder of the .pc file; the others are told from there.
file(RELATIVE_PATH TETLOD_PC_TO_PREFIX
  ${CMAKE_INSTALL_PREFIX}/${TETLOD_PKGCONFIG_DIR} ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" TETLOD_PC_TO_PREFIX "${TETLOD_PC_TO_PREFIX}")
set(TETLOD_PC_FILES tetlod)
if(TARGET tetlod_fortran)
  list(APPEND TETLOD_PC_FILES tetlod_fortran)
endif()
foreach(name IN LISTS TETLOD_PC_FILES)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/cmake/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/cmake/${name}.pc DESTINATION ${TETLOD_PKGCONFIG_DIR}
    COMPONENT development)
endforeach()

# Takes back what the last installation wrote, by its manifest.
if(NOT TARGET uninstall)
  add_custom_target(uninstall VERBATIM
    COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
      -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake)
endif()
