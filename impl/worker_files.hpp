// The arrays of a call and of its answer, in the files that the library shares with the worker.
#pragma once
#include "child_process.hpp"
#include "job.hpp"
#include "patience.hpp"
#include "remesh_protocol.hpp"
#include "worker.hpp"

namespace tetlod {

/// Throws Status::memory where there is no room, before anything is written where the limit of files is known.
void write_arrays(const Descriptor &request_file, const TetgenRequest &request, const Patience &patience, Job &job);

/// What the answer says that cannot be so, or null when the reply has its arrays.
const char *read_arrays(const Descriptor &response_file, const protocol::Reply &answer, const Patience &patience,
                        Job &job, TetgenReply &reply);

bool is_count(std::int64_t count);

}  // namespace tetlod
