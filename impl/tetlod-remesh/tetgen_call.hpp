// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once
#include "remesh_protocol.hpp"

namespace tetlod::worker {

/// Whether TetGen finds five points on a sphere on it. Not so where a compiler has made one instruction of products and
/// sums (-ffp-contract): attempts fail then that need not.
bool has_exact_predicates();

/// One call of TetGen: arrays from the request file, results into the response file. Ends the process on failure.
protocol::Reply tetrahedralize(const protocol::Call &call);

}  // namespace tetlod::worker
