// What is asked of the tets of a result before anybody sees them.
#pragma once
#include <string>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Six times the volume of all tets, less that of those that are not positive.
double six_volumes(Span<const Vec3> points, Span<const Tet> tets, double fraction, Job &job);

/// Of the points as they are handed out. Orders the corners of each tet so that it looks positive in doubles, too.
/// Returns what is wrong, or an empty text. `fraction` is told to the job.
std::string make_all_positive(Span<const Vec3> points, Span<Tet> tets, double fraction, Job &job);

/// Tets that fill what their boundary encloses, and no more, lie side by side, whichever way each is wound. Returns as
/// above.
std::string check_volume(Span<const Vec3> points, Span<const Tet> tets, Span<const Triangle> boundary, double fraction,
                         Job &job);

}  // namespace tetlod
