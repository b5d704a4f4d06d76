#!/usr/bin/env bash
# Holds the direction of dependence between the folders, and the length of files. Prints each line that is against a
# rule; exit status 1 when there is one.
set -u
cd "${1:-.}" || exit 2
broken=0

sources() {
  find "$@" -type f \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' \) 2>/dev/null | sort
}

# rule TEXT LINES: the lines, if any, are what is against it.
rule() {
  [[ -z $2 ]] && return
  printf 'against the rule: %s\n%s\n' "$1" "$2"
  broken=1
}

# lines PATTERN PATH-EXCEPTION FOLDER...: file:line:text of what matches outside the exception.
lines() {
  local pattern=$1 except=$2
  shift 2
  sources "$@" | grep -vE "^($except)" | xargs -r grep -nHE "$pattern"
}

# Comments may speak of what code must not do.
code_only() { sed -E 's@^([^:]*:[0-9]+:)(.*)//.*@\1\2@; \@^[^:]*:[0-9]+: *(/?\*)@d'; }

all=(capi impl bindings tests fuzz)
include='^ *# *include *[<"]'
none='$^'

rule 'OpenMesh is included in impl/decimate_boundary.cpp alone' \
  "$(lines "${include}OpenMesh/" 'impl/decimate_boundary\.cpp$' "${all[@]}")"
rule 'TetGen is included under impl/tetlod-remesh and tests/bench/rivals alone' \
  "$(lines "${include}tetgen" 'impl/tetlod-remesh/|tests/bench/rivals/' "${all[@]}")"
rule 'VTK is included under bindings/cli, bindings/vtk, bindings/paraview, tests/vtk, tests/consumer and tests/bench alone' \
  "$(lines "${include}vtk" 'bindings/cli/|bindings/vtk/|bindings/paraview/|tests/vtk/|tests/consumer/|tests/bench/' "${all[@]}")"
rule 'impl/ does not know tetlod.h' \
  "$(lines "${include}([^\">]*/)?tetlod\.h" "$none" impl)"
rule 'impl/tetlod-remesh is a program of its own: nobody includes from it' \
  "$(lines "${include}[^\">]*tetlod-remesh/" "$none" "${all[@]}")"
speaks='(^|[^_[:alnum:]])(std::c(out|err|log)|(v?f?printf|puts|putchar|perror|_?exit|quick_exit|abort|terminate|assert|s?rand) *\()'
rule 'the library neither prints, exits, aborts nor uses rand' \
  "$(lines "$speaks" 'impl/tetlod-remesh/' impl capi | code_only | grep -E ":[0-9]+:.*$speaks")"

rule 'the library does not sort with memory that the host is not asked for' \
  "$(lines 'std::(stable_sort|stable_partition|inplace_merge)' 'impl/tetlod-remesh/' impl capi)"

# includes_of FOLDER EXCEPTION USER...: lines that include a header of the folder by its name, unless the including
# file's own folder has a header of that name.
includes_of() {
  local folder=$1 except=$2 header name file
  shift 2
  for header in "$folder"/*.hpp; do
    [[ -e $header ]] || continue
    name=$(basename "$header")
    lines "${include}([^\">]*/)?${name//./\\.}[\">]" "$except" "$@" | while IFS= read -r line; do
      file=${line%%:*}
      [[ -e $(dirname "$file")/$name ]] || echo "$line"
    done
  done
}

rule 'of capi/ others include tetlod.h alone' "$(includes_of capi "$none" impl bindings tests fuzz)"
rule 'only unit tests, benchmarks and fuzzers reach past tetlod.h into impl/' \
  "$(includes_of impl 'tests/unit/|tests/bench/' bindings tests)"

# The public header is one file by design, and half of it prose.
too_long() {
  sources "${all[@]}" | xargs -r wc -l |
    awk '$2 != "total" && $1 > ($2 == "capi/tetlod.h" ? 500 : 400) {print $2 ": " $1 " lines"}'
}
rule 'a file has at most 400 lines' "$(too_long)"

# What clang-format does not see. The standard promises 132 columns; the others' width is 120.
fortran() { find "${all[@]}" -type f -name '*.f90' | sort; }
rule 'a Fortran file has at most 400 lines' \
  "$(fortran | xargs -r wc -l | awk '$2 != "total" && $1 > 400 {print $2 ": " $1 " lines"}')"
rule 'a line of Fortran has at most 120 columns, no tab and no space at its end' \
  "$(fortran | xargs -r grep -nHP '^.{121}|\t| $')"
rule 'every Fortran module and program says implicit none' "$(fortran | xargs -r grep -LE '^  implicit none$')"

[[ $broken -eq 0 ]] && echo "the house rules hold"
exit $broken
