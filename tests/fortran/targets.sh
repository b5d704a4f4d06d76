#!/usr/bin/env bash
# targets.sh COMPILER MODULES FOLDER: what is a target can be lent; an expression, or what is no target, does not compile.
set -u
compiler=$1 modules=$2 folder=$3

mkdir -p "$folder"

# lent ARGUMENT: whether a program that lends it compiles; what the compiler says is in FOLDER/said.
lent() {
  cat >"$folder/lent.f90" <<END
program lent
  use, intrinsic :: iso_fortran_env, only: int8, real64
  use tetlod
  implicit none
  real(real64), target :: values(9) = 0
  real(real64) :: untargeted(9) = 0
  integer(int8), target :: flags(9) = 0_int8
  integer(int8) :: untargeted_flags(9) = 0_int8
  type(tetlod_context) :: lod
  call lod%$1
  print *, values, untargeted, flags, untargeted_flags
end program
END
  "$compiler" -fsyntax-only -I"$modules" "$folder/lent.f90" >"$folder/said" 2>&1
}

for argument in values 'values(::2)' 'values(9:1:-1)'; do
  lent "submit_scalars('s', $argument)" || { echo "cannot lend $argument: $(cat "$folder/said")"; exit 1; }
done
lent "submit_point_flags(flags)" || { echo "cannot lend flags: $(cat "$folder/said")"; exit 1; }

for call in "submit_scalars('s', untargeted)" "submit_scalars('s', 2 * values)" "submit_scalars('s', (values))" \
  "submit_steering('s', 1d0, untargeted)" "submit_points_xyz(values, values, untargeted)" \
  "submit_points(reshape(values, [3, 3]))" "submit_point_flags(untargeted_flags)"; do
  lent "$call" && { echo "compiles: $call"; exit 1; }
  grep -q Error "$folder/said" || { echo "no error of the compiler for $call: $(cat "$folder/said")"; exit 1; }
done
echo "targets are lent, the rest does not compile"
