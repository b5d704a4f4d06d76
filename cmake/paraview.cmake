# The ParaView plugin (bindings/paraview), built by a CMake of its own: ParaView's package brings its own VTK, whose
# targets and functions have the names of the other VTK's. ParaView_DIR, else CMAKE_PREFIX_PATH, says where to look first.
if(TETLOD_ALONE)
  set(default AUTO)
else()
  set(default OFF)
endif()
set(TETLOD_PARAVIEW ${default} CACHE STRING "Build the ParaView plugin: AUTO (where ParaView's development files are), ON, OFF")
set_property(CACHE TETLOD_PARAVIEW PROPERTY STRINGS AUTO ON OFF)

# The folder of paraview-config.cmake, or nothing: find_package would load what it finds.
function(tetlod_find_paraview out)
  foreach(prefix IN LISTS CMAKE_PREFIX_PATH CMAKE_SYSTEM_PREFIX_PATH)
    file(GLOB found ${prefix}/lib/cmake/paraview-5.1*/paraview-config.cmake
      ${prefix}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-5.1*/paraview-config.cmake)
    if(found)
      list(GET found -1 config)
      get_filename_component(folder ${config} DIRECTORY)
      set(${out} ${folder} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${out} "" PARENT_SCOPE)
endfunction()

# What ParaView's programs need of the environment where its tree was unpacked to another place than /usr.
function(tetlod_paraview_environment folder out)
  string(REGEX REPLACE "/cmake/[^/]*$" "" libraries ${folder})
  string(REGEX REPLACE "/lib(/${CMAKE_LIBRARY_ARCHITECTURE})?$" "" prefix ${libraries})
  set(${out} LD_LIBRARY_PATH=${libraries} PYTHONPATH=${prefix}/lib/python3/dist-packages PARENT_SCOPE)
  set(TETLOD_PARAVIEW_PREFIX ${prefix} PARENT_SCOPE)
endfunction()

function(tetlod_add_paraview_plugin folder environment)
  include(ExternalProject)
  set(build ${PROJECT_BINARY_DIR}/paraview)
  ExternalProject_Add(tetlod_paraview
    DEPENDS tetlod
    SOURCE_DIR ${PROJECT_SOURCE_DIR}/bindings/paraview
    BINARY_DIR ${build}
    PREFIX ${build}/steps
    CMAKE_ARGS -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_C_COMPILER=${CMAKE_C_COMPILER} -DParaView_DIR=${folder} -Dtetlod_DIR=${PROJECT_BINARY_DIR}/cmake
      -DCMAKE_INSTALL_LIBDIR=${CMAKE_INSTALL_LIBDIR} -DCMAKE_INSTALL_RPATH_USE_LINK_PATH=OFF
    BUILD_COMMAND ${CMAKE_COMMAND} -E env ${environment} ${CMAKE_COMMAND} --build ${build} -j 1
    BUILD_ALWAYS ON
    INSTALL_COMMAND "")
  install(SCRIPT ${build}/cmake_install.cmake COMPONENT paraview_plugins)
endfunction()

# ParaView's programs cannot load a library full of a sanitizer.
if(TETLOD_PARAVIEW AND NOT TETLOD_SANITIZE)
  if(NOT ParaView_DIR)
    tetlod_find_paraview(ParaView_DIR)
  endif()
  if(ParaView_DIR)
    message(STATUS "ParaView plugin: for ${ParaView_DIR}")
    tetlod_paraview_environment(${ParaView_DIR} TETLOD_PARAVIEW_ENVIRONMENT)
    tetlod_add_paraview_plugin(${ParaView_DIR} "${TETLOD_PARAVIEW_ENVIRONMENT}")
  elseif(TETLOD_PARAVIEW STREQUAL AUTO)
    message(STATUS "ParaView plugin: not built, ParaView's development files are not found (./dev setup paraview)")
  else()
    message(FATAL_ERROR "ParaView plugin: ParaView's development files are not found; ParaView_DIR says where they are")
  endif()
endif()
