#include "face_sweep.hpp"

#include <functional>
#include <utility>

namespace tetlod {

/// Of very many, too, it is soon known.
Array<std::uint8_t> find_given_again(Span<const FaceUse> uses, Span<const Tet> tets, Job &job) {
  using Tip = std::pair<std::int32_t, std::size_t>;  // of which use
  Array<Tip> tips(&job.memory);
  for (std::size_t i = 0; i < uses.size(); i++) tips.emplace_back(tip_of(uses[i], tets), i);
  std::sort(tips.begin(), tips.end(), PollingLess(job, 0, std::less<Tip>()));
  Array<std::uint8_t> again(uses.size(), 0, &job.memory);
  for (std::size_t i = 1; i < tips.size(); i++) again[tips[i].second] = tips[i].first == tips[i - 1].first;
  return again;
}

}  // namespace tetlod
