// Error against size: each preset and the peer on one mesh, at several sizes.
#pragma once

#include <string>
#include <vector>

#include "bench_mesh.hpp"
#include "quality.hpp"
#include "spread.hpp"

namespace bench {

// What one method made of the mesh. The peer is random: each of its figures is the median of the rounds.
struct Entry {
  std::string method;  // "paper", "fast", "accurate" or "peer"
  std::int64_t tets;
  Quality quality;
  Spread wall, cpu;
};

// At one size: first the peer, then the presets, asked for as many tets as the peer left; without the peer where it is
// known to stop above that size.
struct SizeRow {
  double asked;  // part of the tets
  std::vector<Entry> entries;
};

struct Sweep {
  std::string set;
  std::int64_t points, tets;
  std::vector<SizeRow> rows;
};

struct SweepOptions {
  std::vector<double> sizes{0.2, 0.1, 0.05, 0.02};  // parts of the tets
  int rounds = 3;
  std::int64_t threads = 1;
  std::string judge;  // a program from outside that is asked about each result, too; empty: none
};

Sweep sweep_set(const std::string &name, const Mesh &mesh, const SweepOptions &options);

// Of a row; null where the peer has none.
const Entry *peer_of(const SizeRow &row);
// Whether ratios to the peer mean something: within a tenth of its size.
bool is_comparable(const Entry &entry, const Entry &peer);

}  // namespace bench
