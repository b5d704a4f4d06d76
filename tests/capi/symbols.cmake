# What libtetlod.so shows and asks for, and that header, map and version agree; and that functions, their versions and
# the numbers of the header are those of abi.txt, with which programs were compiled that run today. Lines are added
# there, and none is changed or taken away.
#   cmake -DNM=... -DLIBRARY=... -DHEADER=... -DMAP=... -DVERSION=... -DCHECK_IMPORTS=ON -P symbols.cmake
cmake_minimum_required(VERSION 3.20)

set(failures "")
macro(complain)
  string(CONCAT line ${ARGV})
  list(APPEND failures "${line}")
endmacro()

# Lists in `out` the names that nm prints with `option`, and in `out`_versioned the same with their versions.
function(dynamic_symbols out option)
  execute_process(COMMAND ${NM} -D -P ${option} ${LIBRARY} OUTPUT_VARIABLE lines RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${NM} -D ${option} ${LIBRARY}: ${code}")
  endif()
  string(REGEX MATCHALL "[^\n]+" lines "${lines}")
  set(names "")
  set(versioned "")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^TETLOD_[0-9.]+(@.*)? A")
      string(REGEX REPLACE "[@ ].*" "" name "${line}")
      string(REGEX REPLACE " .*" "" version "${line}")
      list(APPEND names "${name}")
      list(APPEND versioned "${version}")
    endif()
  endforeach()
  list(SORT names)
  set(${out} "${names}" PARENT_SCOPE)
  set(${out}_versioned "${versioned}" PARENT_SCOPE)
endfunction()

# Complains about the members of `list` that `other` does not have.
macro(each_in list other)
  foreach(name IN LISTS ${list})
    if(NOT name IN_LIST ${other})
      complain("${name} is in the ${list}, not in the ${other}")
    endif()
  endforeach()
endmacro()

file(READ ${HEADER} header_text)
string(REGEX MATCHALL "TETLOD_API [^(;]*tetlod_[a-z_]+\\(" declarations "${header_text}")
set(header "")
foreach(declaration IN LISTS declarations)
  string(REGEX REPLACE ".*(tetlod_[a-z_]+)\\($" "\\1" name "${declaration}")
  list(APPEND header ${name})
endforeach()

file(READ ${MAP} map_text)
string(REGEX MATCHALL "tetlod_[a-z_]+" map "${map_text}")

dynamic_symbols(exports --defined-only)
dynamic_symbols(imports --undefined-only)

each_in(header map)
each_in(map header)
each_in(header exports)
each_in(exports header)

string(REGEX REPLACE "/[*]([^*]|[*]+[^*/])*[*]+/" "" code "${header_text}")
string(REGEX MATCHALL "TETLOD_[A-Z0-9_]+ = [0-9]+" numbers "${code}")
set(abi ${exports_versioned} ${numbers})
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/abi.txt once)
foreach(line IN LISTS once)
  if(NOT line IN_LIST abi)
    complain("programs that run today have ${line}: it is not there any more")
  endif()
endforeach()
foreach(line IN LISTS abi)
  if(NOT line IN_LIST once)
    complain("${line} is new: add the line to abi.txt")
  endif()
endforeach()
list(LENGTH header count)
list(LENGTH numbers number_count)

# A library does not end, talk, or roll dice. __assert_fail: asserts are for debug builds. Not here: std::terminate,
# which the compiler puts behind every noexcept, and snprintf, which writes to memory.
if(CHECK_IMPORTS)
  foreach(name IN ITEMS
          exit _exit _Exit quick_exit abort __assert_fail assert
          printf vprintf fprintf vfprintf puts fputs putchar putc perror
          __printf_chk __fprintf_chk __vfprintf_chk _ZSt4cout _ZSt4cerr _ZSt4clog
          srand rand srandom random srand48 drand48 setlocale signal sigaction setenv putenv system fork)
    if(name IN_LIST imports)
      complain("the library imports ${name}")
    endif()
  endforeach()
endif()

foreach(part IN ITEMS MAJOR MINOR PATCH)
  string(REGEX MATCH "#define TETLOD_VERSION_${part} ([0-9]+)" ignored "${header_text}")
  list(APPEND header_version ${CMAKE_MATCH_1})
endforeach()
list(JOIN header_version "." header_version)
if(NOT header_version VERSION_EQUAL VERSION)
  complain("the header is of version ${header_version}, the project of ${VERSION}")
endif()

if(failures)
  list(JOIN failures "\n  " text)
  message(FATAL_ERROR "\n  ${text}")
endif()
message("ok: ${count} functions in header, map and library, ${number_count} numbers")
