#!/usr/bin/env bash
# complete.sh HEADER WRAPPER: every function of tetlod.h is used by the C++ wrapper, under its name without the prefix.
set -u
functions=$(tr '\n' ' ' <"$1" | grep -oE 'TETLOD_API [^(;]*tetlod_[a-z_0-9]+\(' | grep -oE 'tetlod_[a-z_0-9]+\($' | tr -d '(' | sort)
[[ -n $functions ]] || { echo "no functions in $1"; exit 1; }
broken=0
for name in $functions; do
  grep -qE "\b$name\b" "$2" || { echo "$name is not called"; broken=1; }
  [[ $name == tetlod_create || $name == tetlod_destroy ]] && continue # constructor and destructor
  grep -qE "[ *]${name#tetlod_}\(" "$2" || { echo "${name#tetlod_} is not there"; broken=1; }
done
[[ $broken -eq 0 ]] && echo "$(echo "$functions" | wc -l) functions: all are there"
exit $broken
