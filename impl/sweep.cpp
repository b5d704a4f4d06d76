#include "sweep.hpp"

namespace tetlod {

namespace {

constexpr std::size_t largest_batch = 256;

template <class Visit>
void for_each_use(const AdaptiveMesh &mesh, const Visit &visit) {
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    if (mesh.alive(std::int32_t(t)))
      for (std::int32_t v : mesh.tets[t]) visit(std::int32_t(t), v);
}

}  // namespace

TetsOfVertices::TetsOfVertices(const AdaptiveMesh &mesh)
    : first_(mesh.points.size() + 1, 0, &mesh.memory()), tets_(&mesh.memory()) {
  for_each_use(mesh, [&](std::int32_t, std::int32_t v) { first_[std::size_t(v) + 1]++; });
  for (std::size_t v = 0; v + 1 < first_.size(); v++) first_[v + 1] += first_[v];
  tets_.resize(first_.back());
  Array<std::uint32_t> place(first_.begin(), first_.end(), &mesh.memory());
  for_each_use(mesh, [&](std::int32_t t, std::int32_t v) { tets_[place[std::size_t(v)]++] = t; });
}

Array<std::size_t> batches_of(std::size_t count, std::size_t batch, Memory &memory) {
  Array<std::size_t> ends(&memory);
  for (std::size_t end = batch; end < count; end += batch) ends.push_back(end);
  if (count > 0) ends.push_back(count);
  return ends;
}

Array<std::size_t> batches_apart(const AdaptiveMesh &mesh, const TetsOfVertices &tets, Array<std::int32_t> &vertices) {
  std::sort(vertices.begin(), vertices.end(), [&](std::int32_t a, std::int32_t b) {
    const std::int32_t s = tets.of(a)[0], t = tets.of(b)[0];
    return s != t ? s < t : a < b;
  });
  Array<std::size_t> ends(&mesh.memory());
  Array<std::size_t> taken(mesh.tets.size(), 0, &mesh.memory());  // by a vertex of which batch
  Array<std::int32_t> ordered(&mesh.memory()), left(vertices, &mesh.memory()), later(&mesh.memory());
  while (!left.empty()) {
    const std::size_t batch = ends.size() + 1, begin = ordered.size();
    later.clear();
    for (std::int32_t v : left) {
      const Span<const std::int32_t> star = tets.of(v);
      const bool apart =
          ordered.size() < begin + largest_batch &&
          std::none_of(star.begin(), star.end(), [&](std::int32_t t) { return taken[std::size_t(t)] == batch; });
      (apart ? ordered : later).push_back(v);
      if (apart)
        for (std::int32_t t : star) taken[std::size_t(t)] = batch;
    }
    ends.push_back(ordered.size());
    left.swap(later);
  }
  vertices.swap(ordered);
  return ends;
}

}  // namespace tetlod
