// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once
#include "remesh_protocol.hpp"

namespace tetlod::worker {

/// One call of TetGen: arrays from the request file, results into the response file. Ends the process on failure.
protocol::Reply tetrahedralize(const protocol::Call &call);

}  // namespace tetlod::worker
