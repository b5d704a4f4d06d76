// Where the boundary of tets is folded back on itself along an edge, as where two solids have a part of a face in
// common and lie on one another beside it.
#pragma once
#include <utility>

#include "numbered_tets.hpp"

namespace tetlod {

/// The two tets of each such edge. At vertices of very many triangles none are looked for.
Array<std::pair<std::int32_t, std::int32_t>> find_folded_back(const NumberedTets &tets, Job &job);

}  // namespace tetlod
