#!/usr/bin/env bash
# complete.sh HEADER FOLDER: every function, number and struct member of tetlod.h is in the Fortran module of FOLDER.
set -u
header=$1 folder=$2 broken=0

# compare WHAT HEADER-LIST FORTRAN-LIST: both are the same, and not empty.
compare() {
  [[ -n $2 ]] || { echo "found no $1 in $header"; broken=1; }
  diff <(echo "$2") <(echo "$3") >/dev/null && return
  echo "$1: < tetlod.h, > Fortran"
  diff <(echo "$2") <(echo "$3") | grep '^[<>]'
  broken=1
}

code() { sed -E 's@/\*.*\*/@@' "$header" | awk '/\/\*/ {sub(/\/\*.*/, ""); print; skip = 1; next} skip && /\*\// {sub(/.*\*\//, ""); skip = 0} !skip'; }

functions=$(code | tr '\n' ' ' | grep -oE 'TETLOD_API [^(;]*tetlod_[a-z_0-9]+\(' | grep -oE 'tetlod_[a-z_0-9]+\($' | tr -d '(' | sort)
bound=$(grep -ohE 'bind\(C, name="tetlod_[a-z_0-9]+"' "$folder/tetlod_c.f90" | grep -oE 'tetlod_[a-z_0-9]+' | sort)
compare functions "$functions" "$bound"

# Each is reached by its name: a module procedure tetlod_x, or x among the procedures of a context.
for name in $functions; do
  short=${name#tetlod_}
  grep -qE "^ +(subroutine|function) $name\(" "$folder/tetlod.f90" && continue
  grep -qE "^    (procedure|generic) :: $short( =>|$)" "$folder"/tetlod_{lifetime,settings,submission,fields,results}.f90 && continue
  echo "no program can call $name"
  broken=1
done

numbers=$(code | sed '/^#/d' | grep -oE 'TETLOD_[A-Z0-9_]+ = [0-9]+' | sort)
parameters=$(grep -oE 'TETLOD_[A-Z0-9_]+ = [0-9]+' "$folder/tetlod_types.f90" | grep -v TETLOD_VERSION_ | sort)
compare numbers "$numbers" "$parameters"
compare version "$(grep -oE '^#define TETLOD_VERSION_[A-Z]+ [0-9]+' "$header" | cut -d' ' -f2- | sort)" \
  "$(grep -oE 'TETLOD_VERSION_[A-Z]+ = [0-9]+' "$folder/tetlod_types.f90" | sed 's/ =//' | sort)"

# STRUCT TYPE MEMBER, in order, by the names that iso_c_binding has for the types.
members() {
  code | sed -E 's/void \*\(\*/funptr (/' | tr '\n' ' ' | grep -oE 'typedef struct [a-z_]+ \{[^}]*\}' | while read -r _ _ struct body; do
    echo "${body#\{}" | tr -d '}' | tr ';' '\n' | sed -E 's/\([^()]*\)$//; s/void \(\*/funptr (/; s/[()]//g; s/^ +//' |
      while read -r line; do
        [[ -z $line ]] && continue
        line=${line#const }
        type=${line%% *}
        [[ $line == *\** ]] && type=ptr
        for member in $(echo "${line#* }" | tr -d '* ' | tr ',' ' '); do echo "$struct $type $member"; done
      done
  done | sed -E 's/ (uint32_t|int32_t|tetlod_status) / int32 /; s/ (uint64_t|int64_t) / int64 /'
}
components() {
  awk '/^ *type, bind\(C\), public ::/ {struct = $NF; next} /^ *end type/ {struct = ""} struct && / :: / {print struct, $0}' \
    "$folder/tetlod_types.f90" |
    sed -E 's/(integer|real|type)\((c_)?([a-z0-9_]+)\) ::/\3/; s/int(32|64)_t/int\1/; s/ = [a-z0-9_]+//g; s/,/ /g' |
    while read -r struct type rest; do for member in $rest; do echo "$struct $type $member"; done; done
}
compare "struct members" "$(members | sort -s -k1,1)" "$(components | sort -s -k1,1)"

[[ $broken -eq 0 ]] && echo "$(echo "$functions" | wc -l) functions, $(echo "$numbers" | wc -l) numbers: all are bound"
exit $broken
