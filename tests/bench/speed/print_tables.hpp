// What was measured, for people.
#pragma once

#include <cstdio>

#include "duel.hpp"
#include "fresh_contest.hpp"
#include "growth.hpp"

namespace bench {

// What the figures depend on: the library, the cores, and how busy they are.
void print_head(std::FILE *to);
void print_contest(std::FILE *to, const Contest &contest);
// Contests and duels in one table of speeds: least, median and most of the rounds.
void print_speeds(std::FILE *to, const std::vector<Contest> &contests, const std::vector<Duel> &duels);
// Seconds in new programs, the least of the rounds, a line a contest.
void print_fresh_head(std::FILE *to, const std::vector<std::int64_t> &threads);
void print_fresh(std::FILE *to, const FreshContest &contest);
void print_growth(std::FILE *to, const Growth &growth);

}  // namespace bench
