// What was measured, for programs.
#pragma once

#include <optional>

#include "duel.hpp"
#include "fresh_contest.hpp"
#include "growth.hpp"

namespace bench {

// Throws std::runtime_error when the file cannot be written.
void write_json(const std::string &path, const std::vector<Contest> &contests, const std::vector<Duel> &duels,
                const std::optional<Growth> &growth, const std::vector<FreshContest> &fresh);

}  // namespace bench
