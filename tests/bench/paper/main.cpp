// The paper's tables again, beside the paper's figures. Seconds are of the processors, with one thread.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tables.hpp"

int main(int argc, char **argv) {
  bench::PaperOptions options;
  std::vector<std::string> parts;
  CLI::App app("The paper's tables beside those of the sets in hand, as Markdown.", "bench_paper");
  app.add_option("PART", parts, "table1, table2, sets [all]")->check(CLI::IsMember({"table1", "table2", "sets"}));
  app.add_option("--peer-seconds", options.peer_seconds, "CPU seconds after which the peer is stopped")
      ->capture_default_str();
  app.add_flag("--large", options.large, "with the set of 1.5 million tets; the peer needs long for it");
  CLI11_PARSE(app, argc, argv);
  if (parts.empty()) parts = {"table1", "table2", "sets"};
  try {
    for (const std::string &part : parts) {
      std::printf("\n%s\n\n", part == "table1" ? "Table 1" : part == "table2" ? "Table 2" : "Sets");
      if (part == "table1") bench::print_table1(stdout, options);
      if (part == "table2") bench::print_table2(stdout);
      if (part == "sets") bench::print_sets(stdout, options);
    }
    return EXIT_SUCCESS;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_paper: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
