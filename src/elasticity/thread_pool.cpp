#include "thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace cfem_cutting {

namespace {

/// Turns of waiting awake, some hundreds of microseconds: coarse levels, which are for one thread, take less
/// than that, and a thread that fell asleep is late.
constexpr int kSpins = 10000;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable start, done;
  std::vector<std::thread> workers;
  const std::function<void(int, int)>* work = nullptr;
  int count = 0, parts = 0;
  std::atomic<int> pending{0};  // workers that have not finished this round
  std::atomic<long> round{0};
  bool stop = false;

  void run_part(int part) const {
    if (part >= parts) return;
    const auto bound = [&](int p) { return static_cast<int>(static_cast<long>(count) * p / parts); };
    (*work)(bound(part), bound(part + 1));
  }

  /// Waits until the condition holds, awake at first.
  template <typename Condition>
  void wait(std::condition_variable& changed, const Condition& holds) {
    for (int spin = 0; spin < kSpins; ++spin) {
      if (holds()) return;
      pause();
    }
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait(lock, holds);
  }

  void begin_round() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      pending = static_cast<int>(workers.size());
      ++round;
    }
    start.notify_all();
  }

  void loop(int part) {
    for (long seen = 0;;) {
      wait(start, [&] { return round != seen; });
      seen = round;
      if (stop) return;
      run_part(part);
      if (--pending > 0) continue;
      const std::lock_guard<std::mutex> lock(mutex);
      done.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) : state_(std::make_unique<State>()) {
  if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int part = 1; part < threads; ++part)
    state_->workers.emplace_back([state = state_.get(), part] { state->loop(part); });
}

ThreadPool::~ThreadPool() {
  state_->stop = true;
  state_->begin_round();
  for (std::thread& worker : state_->workers) worker.join();
}

void ThreadPool::for_range(int count, int grain, const std::function<void(int, int)>& work) {
  const int parts = std::min(static_cast<int>(state_->workers.size()) + 1, count / std::max(1, grain));
  if (parts <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  state_->work = &work;
  state_->count = count;
  state_->parts = parts;
  state_->begin_round();
  state_->run_part(0);
  state_->wait(state_->done, [&] { return state_->pending == 0; });
}

}  // namespace cfem_cutting
