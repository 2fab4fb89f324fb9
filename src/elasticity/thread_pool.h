#pragma once

#include <functional>
#include <memory>

namespace cfem_cutting {

/// Threads that wait between calls, awake for a moment and then asleep; for one caller at a time. The work is
/// split by index only, so that results which do not depend on the split are the same for any number of
/// threads.
class ThreadPool {
 public:
  /// @param threads 0: as many as there are cores
  explicit ThreadPool(int threads);
  ~ThreadPool();

  /// Calls work(begin, end) on parts of [0, count), each of at least `grain` (or one, if there is less), and
  /// waits. A thread has a few parts, which others take over if it is late. `work` must not throw; inside,
  /// subnormal numbers are zero.
  void for_range(int count, int grain, const std::function<void(int, int)>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cfem_cutting
