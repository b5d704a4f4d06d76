# Runs a host as four ranks on this machine: mpi.sh MPIEXEC PROGRAM. Nothing may be printed. Without arguments there is
# no MPI, and the test is skipped (77).
set -u
if [[ $# -lt 2 || ! -x $1 ]]; then
  echo "skipped: no MPI here"
  exit 77
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
output=$("$1" -n 4 "$2" 4 2>&1)
code=$?
[[ -z $output ]] || { echo "printed: $output" >&2; exit 1; }
exit $code
