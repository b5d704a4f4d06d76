# The filter vtkTetlodSimplify as a VTK module (bindings/vtk): a library for C++, and the Python package vtktetlod where
# VTK's wrapping tools (Debian: with libvtk9-dev), Python's headers (python3-dev) and VTK's Python modules
# (python3-vtk9) are found.
#
# What the tool and the tests need of VTK is found here, too: VTK's targets are of the folder that finds them first.
find_package(VTK 9 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersGeneral
  FiltersGeometry IOImage IOLegacy IOParallelXML IOXML RenderingFreeType)

set(TETLOD_VTK_PYTHON OFF)
if(VTK_WRAP_PYTHON AND TARGET VTK::WrapPython)
  # The Python that this VTK was built for, not the first in PATH.
  if(NOT Python3_ROOT_DIR)
    set(Python3_ROOT_DIR ${VTK_PREFIX_PATH})
  endif()
  set(Python3_FIND_STRATEGY LOCATION)
  find_package(Python3 QUIET COMPONENTS Interpreter Development)
  set(TETLOD_PYTHON_FOUND ${Python3_Development_FOUND})  # VTK looks for less of Python, and forgets this
  find_package(VTK 9 QUIET OPTIONAL_COMPONENTS WrappingPythonCore Python)
  if(TETLOD_PYTHON_FOUND AND VTK_WrappingPythonCore_FOUND)
    set(TETLOD_VTK_PYTHON ON)
  endif()
endif()
message(STATUS "Python wrapping of vtkTetlodSimplify: ${TETLOD_VTK_PYTHON}")

# In a function, so that the module alone is shared unless told.
function(tetlod_add_vtk_module)
  set(BUILD_SHARED_LIBS ON)
  vtk_module_scan(
    MODULE_FILES ${PROJECT_SOURCE_DIR}/bindings/vtk/vtk.module
    REQUEST_MODULES Tetlod::vtkTetlod
    PROVIDES_MODULES modules
    ENABLE_TESTS OFF)
  vtk_module_build(
    MODULES ${modules}
    PACKAGE tetlodVTK
    ENABLE_WRAPPING ${TETLOD_VTK_PYTHON}
    INSTALL_HEADERS ON
    TARGETS_COMPONENT tool
    TEST_DIRECTORY_NAME NONE)
  set_target_properties(vtkTetlod PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
    INSTALL_RPATH "$ORIGIN")
  if(TETLOD_VTK_PYTHON)
    vtk_module_wrap_python(
      MODULES ${modules}
      PYTHON_PACKAGE vtktetlod
      MODULE_DESTINATION ${TETLOD_PYTHON_DIR}
      INSTALL_HEADERS OFF)
    set_target_properties(vtkTetlodPython PROPERTIES INSTALL_RPATH "$ORIGIN/../../..")
  endif()
endfunction()

set(TETLOD_PYTHON_DIR ${CMAKE_INSTALL_LIBDIR}/python3/dist-packages)
tetlod_add_vtk_module()
if(TETLOD_VTK_PYTHON)
  set(package ${PROJECT_BINARY_DIR}/${TETLOD_PYTHON_DIR}/vtktetlod)
  file(WRITE ${package}/__init__.py
    "\"\"\"tetlod for VTK: from vtktetlod import vtkTetlodSimplify\"\"\"\nfrom .vtkTetlod import *\n")
  install(FILES ${package}/__init__.py DESTINATION ${TETLOD_PYTHON_DIR}/vtktetlod COMPONENT python)
endif()
