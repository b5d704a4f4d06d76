# Flags of fast mathematics: -Ofast is refused, and where a project has another one, this one is compiled without.
set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -DTETLOD_CLI=OFF -DTETLOD_FORTRAN=OFF -DTETLOD_WORKER=OFF
  -DTETLOD_EXAMPLES=OFF -DTETLOD_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
file(REMOVE_RECURSE ${WORK})

execute_process(COMMAND ${configure} -B ${WORK}/refused -DCMAKE_CXX_FLAGS=-Ofast
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE errors)
if(result EQUAL 0 OR NOT errors MATCHES "CMAKE_CXX_FLAGS has -Ofast")
  message(FATAL_ERROR "-Ofast is not refused: ${errors}")
endif()

execute_process(COMMAND ${configure} -B ${WORK}/undone -DCMAKE_CXX_FLAGS=-ffast-math
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "-ffast-math is refused: ${errors}")
endif()
file(STRINGS ${WORK}/undone/compile_commands.json commands REGEX "predicates.cpp")
if(NOT commands MATCHES "-ffast-math.* -fno-fast-math")
  message(FATAL_ERROR "predicates are compiled with fast mathematics: ${commands}")
endif()
