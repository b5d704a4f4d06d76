#include "sweep.hpp"

namespace tetlod {

namespace {

constexpr std::size_t largest_batch = 256;

}  // namespace

Array<std::size_t> batches_of(std::size_t count, std::size_t batch, Memory &memory) {
  Array<std::size_t> ends(&memory);
  for (std::size_t end = batch; end < count; end += batch) ends.push_back(end);
  if (count > 0) ends.push_back(count);
  return ends;
}

Array<std::size_t> batches_apart(const TetComplex &mesh, const StarLists &tets, Job &job,
                                 Array<std::int32_t> &vertices) {
  const auto before = [&](std::int32_t a, std::int32_t b) {
    const std::int32_t s = tets.of(a)[0], t = tets.of(b)[0];
    return s != t ? s < t : a < b;
  };
  std::sort(vertices.begin(), vertices.end(), PollingLess(job, 0, before));
  Array<std::size_t> ends(&mesh.memory());
  Array<std::size_t> taken(mesh.tets.size(), 0, &mesh.memory());  // by a vertex of which batch
  Array<std::int32_t> ordered(&mesh.memory()), waiting(&mesh.memory()), still_waiting(&mesh.memory());
  ordered.reserve(vertices.size());
  for (std::size_t next = 0; next < vertices.size() || !waiting.empty();) {
    if (ends.size() % 16 == 0) job.poll(0);
    const std::size_t batch = ends.size() + 1, full = ordered.size() + largest_batch;
    const auto take_or_leave = [&](std::int32_t v) {
      const Span<const std::int32_t> star = tets.of(v);
      const bool apart = ordered.size() < full && std::none_of(star.begin(), star.end(), [&](std::int32_t t) {
                           return taken[std::size_t(t)] == batch;
                         });
      (apart ? ordered : still_waiting).push_back(v);
      if (apart)
        for (std::int32_t t : star) taken[std::size_t(t)] = batch;
    };
    still_waiting.clear();
    for (std::int32_t v : waiting) take_or_leave(v);
    while (next < vertices.size() && ordered.size() < full) take_or_leave(vertices[next++]);
    waiting.swap(still_waiting);
    ends.push_back(ordered.size());
  }
  vertices.swap(ordered);
  return ends;
}

}  // namespace tetlod
