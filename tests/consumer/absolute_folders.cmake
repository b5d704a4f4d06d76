# Folders that were asked for as absolute ones: what is installed finds them from the prefix all the same.
# cmake -DSOURCE= -DWORK= -DGENERATOR= -P absolute_folders.cmake
cmake_minimum_required(VERSION 3.20)
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G ${GENERATOR} -DCMAKE_INSTALL_PREFIX=/some/prefix
  -DCMAKE_INSTALL_LIBDIR=/some/prefix/lib64 -DCMAKE_INSTALL_INCLUDEDIR=/some/headers
  -DTETLOD_CLI=OFF -DTETLOD_TESTS=OFF -DTETLOD_EXAMPLES=OFF
  RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${said}")
endif()

function(expect_line file line)
  file(STRINGS ${WORK}/cmake/${file} lines)
  if(NOT line IN_LIST lines)
    list(JOIN lines "\n" text)
    message(FATAL_ERROR "${file} has no line '${line}':\n${text}")
  endif()
endfunction()

expect_line(tetlod.pc [[prefix=${pcfiledir}/../..]])
expect_line(tetlod.pc [[libdir=${prefix}/lib64]])
expect_line(tetlod.pc [[includedir=${prefix}/../headers]])
file(READ ${WORK}/cmake_install.cmake script)
if(NOT script MATCHES [[/lib64/pkgconfig]] OR script MATCHES [["/some/prefix/lib64]])
  message(FATAL_ERROR "what would be installed does not follow the prefix:\n${script}")
endif()
