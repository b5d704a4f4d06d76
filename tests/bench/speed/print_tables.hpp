// What was measured, for people.
#pragma once

#include <cstdio>

#include "growth.hpp"

namespace bench {

// What the figures depend on: the library, the cores, and how busy they are.
void print_head(std::FILE *to);
void print_contest(std::FILE *to, const Contest &contest);
void print_growth(std::FILE *to, const Growth &growth);

}  // namespace bench
