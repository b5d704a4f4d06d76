/* The ABI as a C99 program sees it: only tetlod.h, no C++. Prints "ok N checks". */
#include <stdio.h>

#include "c99_support.h"

static void run_part(const char *name, void (*part)(void)) {
  const int before = checks_failed();
  part();
  if (checks_failed() != before) fprintf(stderr, "in %s\n", name);
}

int main(void) {
  run_part("texts", test_texts);
  run_part("names", test_names);
  run_part("contexts", test_contexts);
  run_part("options", test_options);
  run_part("submit", test_submit);
  run_part("layouts", test_layouts);
  run_part("fetch", test_fetch);
  run_part("error and histogram", test_error_and_histogram);
  run_part("statuses of meshes", test_mesh_statuses);
  if (checks_failed()) {
    fprintf(stderr, "%d of %d checks failed\n", checks_failed(), checks_made());
    return EXIT_FAILURE;
  }
  printf("ok %d checks\n", checks_made());
  return EXIT_SUCCESS;
}
