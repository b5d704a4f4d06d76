/* A host as it is run on a cluster: several contexts' worth of work, then silence. Built with MPI it is a rank of many,
 * which compares what the ranks got; without, a process of its own. Ends with 0 when all is well. */
#define _XOPEN_SOURCE 700 /* waitid */
#include <errno.h>
#include <stdio.h>
#include <sys/wait.h>

#include "c99_support.h"

#ifdef WITH_MPI
#include <mpi.h>

/* The least and the greatest of a number over the ranks. */
static void span_of(uint64_t number, uint64_t *least, uint64_t *most) {
  MPI_Allreduce(&number, least, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&number, most, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
}
#endif

static uint64_t simplify_once(const cube *mesh, double target) {
  tetlod_run_report report;
  tetlod_context *context = new_context();
  uint64_t hash = 0;
  submit_cube(context, mesh);
  OK(context, tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, target));
  OK(context, tetlod_run(context));
  report.struct_size = sizeof report;
  if (OK(context, tetlod_fetch_report(context, &report))) hash = report.hash;
  tetlod_destroy(context);
  return hash;
}

static int has_no_child(void) {
  siginfo_t ended;
  return waitid(P_ALL, 0, &ended, WEXITED | WNOHANG | WNOWAIT) != 0 && errno == ECHILD;
}

int main(int argc, char **argv) {
  cube mesh = make_cube(8);
  uint64_t first, again, target;
#ifdef WITH_MPI
  int ranks = 0;
  uint64_t least, most;
  MPI_Init(&argc, &argv);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  CHECK(argc == 2 && ranks == atoi(argv[1]));
#else
  (void)argc, (void)argv;
#endif
  first = simplify_once(&mesh, 0);
  again = simplify_once(&mesh, 0);
  target = simplify_once(&mesh, 0.3);
  CHECK(first != 0 && first == again);
  CHECK(target != 0 && target != first);
  CHECK(has_no_child());
#ifdef WITH_MPI
  span_of(first, &least, &most);
  CHECK(least == most);
  span_of(target, &least, &most);
  CHECK(least == most);
  MPI_Finalize();
#endif
  free_cube(&mesh);
  return checks_failed() == 0 ? 0 : 1;
}
