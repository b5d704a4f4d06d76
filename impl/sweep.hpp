// A pass over the mesh: changes are looked for in parallel, a batch at a time, and made in order, with the same outcome
// for any number of threads.
#pragma once
#include "job.hpp"
#include "star_lists.hpp"
#include "tet_complex.hpp"

namespace tetlod {

/// For each item, find(item, change) says whether there is a change to make, from what the mesh is, and make(change)
/// makes it. Change has `old`, the tets that it looked at. What an earlier change of its batch has touched is looked
/// for again. ends: where each batch ends.
template <class Change, class Find, class Make>
void sweep(Span<const std::int32_t> items, Span<const std::size_t> ends, Job &job, TetComplex &mesh, const Find &find,
           const Make &make) {
  constexpr std::size_t grain = 8;
  std::size_t first = 0, largest = 0;
  for (const std::size_t end : ends) {
    largest = std::max(largest, end - first);
    first = end;
  }
  Array<Change> changes(largest, &job.memory);
  Array<std::uint8_t> found(largest, 0, &job.memory);
  first = 0;
  for (const std::size_t end : ends) {
    const std::size_t count = end - first;
    job.parallel.for_blocks(count, grain, [&](std::size_t begin, std::size_t stop) {
      for (std::size_t i = begin; i < stop; i++) found[i] = find(items[first + i], changes[i]);
      job.poll(double(first) / double(items.size()));
    });
    mesh.begin_batch();
    for (std::size_t i = 0; i < count; i++) {
      if (!found[i]) continue;
      if (mesh.touched(changes[i].old) && !find(items[first + i], changes[i])) continue;
      make(changes[i]);
    }
    first = end;
  }
}

/// Batches of so many items.
Array<std::size_t> batches_of(std::size_t count, std::size_t batch, Memory &memory);

/// `tets` of every vertex. Orders inner vertices into batches in which no two share a tet, each along the tets.
Array<std::size_t> batches_apart(const TetComplex &mesh, const StarLists &tets, Job &job,
                                 Array<std::int32_t> &vertices);

}  // namespace tetlod
