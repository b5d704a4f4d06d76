// A sweep as a table in Markdown.
#pragma once

#include <cstdio>

#include "sweep.hpp"

namespace bench {

void write_table_head(std::FILE *to);
void write_table(std::FILE *to, const Sweep &sweep);

}  // namespace bench
