# What an installed tree may contain, and how it goes away again.

# Every file of a prefix, those of Fortran modules unpacked, without the paths of the build and of the source tree, and
# without its own.
function(check_tree prefix)
  check_texts(${prefix})
  check_bytes(${prefix})
endfunction()

# What was installed names neither the folder it was built in nor the one it was installed to first.
function(check_texts prefix)
  file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.pc ${prefix}/*.h ${prefix}/*.hpp ${prefix}/*.f90)
  if(NOT texts)
    message(FATAL_ERROR "nothing was installed to ${prefix}")
  endif()
  foreach(text IN LISTS texts)
    file(READ ${text} contents)
    foreach(path ${BUILD} ${SOURCE} ${prefix})
      string(FIND "${contents}" "${path}/" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${text} names ${path}")
      endif()
    endforeach()
  endforeach()
endfunction()

# Not a byte of a library or program names the build or the source tree either. Modules of gfortran are compressed.
function(check_bytes prefix)
  execute_process(COMMAND grep -rlaF -e ${BUILD}/ -e ${SOURCE}/ ${prefix} OUTPUT_VARIABLE files)
  file(GLOB_RECURSE modules ${prefix}/*.mod)
  foreach(module IN LISTS modules)
    execute_process(COMMAND gzip -dcf INPUT_FILE ${module}
      COMMAND grep -aqF -e ${BUILD}/ -e ${SOURCE}/ RESULTS_VARIABLE results)
    list(GET results 1 found)
    if(found EQUAL 0)
      string(APPEND files "${module}\n")
    endif()
  endforeach()
  if(files)
    message(FATAL_ERROR "these name the build or the source tree:\n${files}")
  endif()
endfunction()

# Uninstalling leaves nothing but what is of others, whatever the folders' names.
function(uninstall_again prefix)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
  set(own "${prefix}/${LIBDIR}/cmake/tetlod/own.txt")
  file(WRITE "${own}" "")
  run(${CMAKE_COMMAND} -DMANIFEST=${BUILD}/install_manifest.txt -P ${SOURCE}/cmake/uninstall.cmake)
  execute_process(COMMAND find "${prefix}" ! -type d OUTPUT_VARIABLE left)
  if(NOT left STREQUAL "${own}\n")
    message(FATAL_ERROR "these are left after uninstalling:\n${left}")
  endif()
endfunction()
