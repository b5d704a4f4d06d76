// From what TetGen answered to a mesh that has passed every check, or to the reason why it has not.
#pragma once
#include <cstdint>
#include <string>

#include "job.hpp"
#include "mesh.hpp"
#include "remesh.hpp"
#include "remesh_frame.hpp"
#include "worker.hpp"

namespace tetlod {

/// What one attempt gives TetGen: the problem in its frame, and which point is which.
struct RemeshInput {
  explicit RemeshInput(Memory &memory)
      : points(&memory), insert(&memory), number(&memory), insert_number(&memory), triangles(&memory) {}
  Frame frame;
  std::string switches;
  Array<Vec3> points;                 ///< in the frame: the surface's and samples
  Array<Vec3> insert;                 ///< in the frame: samples that come by -i
  Array<std::int32_t> number;         ///< of each of points: i < surface points: the surface's i; else + sample index
  Array<std::int32_t> insert_number;  ///< the same of each of insert
  Array<Triangle> triangles;          ///< outward, numbered as points
};

/// Checks the reply and writes points, tets and origin of the result; the reply is used up. Returns what is wrong with
/// it, or an empty text. `fraction` is told to the job.
std::string accept_reply(const RemeshInput &input, const Surface &surface, Span<const Vec3> samples, TetgenReply &reply,
                         double fraction, Job &job, RemeshResult &result);

}  // namespace tetlod
