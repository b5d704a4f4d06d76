#include "parallel.hpp"

namespace tetlod {

Parallel::Parallel(int threads) : threads_(threads) {
  if (threads > 1) crew_.reset(new Crew(threads - 1));
}

void Parallel::EndCrew::operator()(Crew *crew) const noexcept {
  if (!crew->is_elsewhere()) delete crew;
}

bool Parallel::is_cancelled() const { return Loop::current_is_cancelled(); }

void Parallel::for_all(std::size_t blocks, OfBlock run) const {
  if (!crew_ || blocks < 2) {
    for (std::size_t b = 0; b < blocks; b++) run.call(run.body, b);
    return;
  }
  Loop loop(blocks, run);
  crew_->open(loop, blocks - 1);
  loop.take_part();
  crew_->close(loop);
  loop.require_done();
}

}  // namespace tetlod
