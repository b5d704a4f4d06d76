// The paper's tables, with its figures and with those of the sets in hand, as Markdown.
#pragma once

#include <cstdio>

namespace bench {

struct PaperOptions {
  unsigned peer_seconds = 300;  // of the processors, after which the peer is stopped
  bool large = false;           // Table 1 and the sets with the blunt fin of 1.5 million tets, too
};

void print_table1(std::FILE *to, const PaperOptions &options);
void print_table2(std::FILE *to);
// A line for each real set: what the peer did, and what tetlod did.
void print_sets(std::FILE *to, const PaperOptions &options);

}  // namespace bench
