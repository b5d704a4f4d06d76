// Threads that take part in loops, started when there is something to do, for as long as a call of the library takes.
#pragma once
#include <pthread.h>
#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <vector>

namespace tetlod {

/// A function of a block's number, of whatever type.
struct OfBlock {
  const void *body;
  void (*call)(const void *body, std::size_t block);
};

/// Blocks that each thread takes the next of, while it is open in a crew.
class Loop {
 public:
  /// A part of the loop whose block the calling thread is at.
  Loop(std::size_t blocks, OfBlock run);

  /// Until no block is left to take, or it is cancelled, as it is by one that throws.
  void take_part();
  void cancel() { cancelled_.store(true, std::memory_order_release); }
  /// After it was closed: throws what one of its blocks has thrown, or Status::cancelled where blocks may be left.
  void require_done() const;

  /// Of the loop that the calling thread is at a block of, or one that this is a part of.
  static bool current_is_cancelled();

  /// What the calling thread does is no part of the loop that it is at a block of, as long as this is there: a host may
  /// call the library for another mesh in a callback.
  class Apart {
   public:
    Apart() noexcept;
    ~Apart();
    Apart(const Apart &) = delete;
    Apart &operator=(const Apart &) = delete;

   private:
    const Loop *const before_;
  };

 private:
  friend class Crew;
  bool has_more() const;
  bool is_cancelled() const;
  bool is_part_of(const Loop &other) const;

  const std::size_t blocks_;
  const OfBlock run_;
  const Loop *const whole_;  // that it is a part of, or null
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> cancelled_{false}, failed_{false};
  std::exception_ptr failure_;  // of the first that failed
  Loop *opened_before_ = nullptr;
  int helpers_ = 0;  // that take part
  bool closed_ = false;
};

class Crew {
 public:
  /// So many threads beside those that open loops; where the system has no more, it goes on with those that there are.
  explicit Crew(int most);
  ~Crew();  ///< every loop is closed
  Crew(const Crew &) = delete;
  Crew &operator=(const Crew &) = delete;

  /// Up to so many helpers take part from now on. Throws as require_here() does.
  void open(Loop &loop, std::size_t helpers);
  /// Nobody takes a part any more; waits for those that do, and takes part in what are parts of the loop. Throws as
  /// require_here() does.
  void close(Loop &loop);

  /// In a process that was forked while a loop was open nothing may be done with it, not even its end.
  bool is_elsewhere() const;
  /// Throws Status::state there, where no helper ends what it is at.
  void require_here() const;

 private:
  struct Sleepers {
    std::condition_variable wake;
    std::size_t count = 0;
  };

  static void *live(void *crew);
  void serve();
  bool start_helper();
  Loop *find_work(const Loop *whole) const;
  void help(Loop &loop, std::unique_lock<std::mutex> &lock);
  void unlink(Loop &loop);
  void wait_for_change(Sleepers &sleepers, std::unique_lock<std::mutex> &lock);
  void tell_change(std::size_t helpers);

  const pid_t process_;
  std::size_t most_;
  std::mutex mutex_;  // of all that follows, and of what loops have beside atomics
  std::atomic<std::uint64_t> changes_{0};
  Sleepers idle_, closing_;
  std::vector<pthread_t> threads_;
  Loop *opened_last_ = nullptr;
  bool over_ = false;
};

}  // namespace tetlod
