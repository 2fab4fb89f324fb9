#include "thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "subnormals.h"

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

/// Parts a thread has to itself, if there are enough: what it has not begun, others take over when they are
/// done.
constexpr int kPartsPerThread = 4;

/// Parts first, first + 1, ... of one thread. Taken by all, but first by that.
struct alignas(64) Share {
  std::atomic<std::uint64_t> open{0};  // number of the round << 32 | parts that nobody took yet
  int end = 0;

  void put(std::uint64_t round, int first, int last) {
    end = last;
    open = round << 32 | static_cast<std::uint32_t>(last - first);
  }

  /// @return a part, or -1 if there is none left
  int take() {
    std::uint64_t now = open;
    do {
      if (static_cast<std::uint32_t>(now) == 0) return -1;
    } while (!open.compare_exchange_weak(now, now - 1));
    return end - static_cast<int>(static_cast<std::uint32_t>(now));
  }
};

}  // namespace

struct ThreadPool::State {
  explicit State(int threads) : shares(threads) {}

  std::mutex mutex;
  std::condition_variable start, done;
  std::vector<std::thread> workers;
  std::vector<Share> shares;  // the caller's first
  const std::function<void(int, int)>* work = nullptr;
  int count = 0, parts = 0;
  alignas(64) std::atomic<int> unfinished{0};       // parts of this round
  alignas(64) std::atomic<std::uint64_t> round{0};  // all shares are put
  std::atomic<bool> stop{false};

  int threads() const { return static_cast<int>(shares.size()); }

  /// Until a part that was taken is done, work, count and parts stay as they are.
  bool run_part(int thread) {
    int part = -1;
    for (int i = 0; i < threads() && part < 0; ++i) part = shares[(thread + i) % threads()].take();
    if (part < 0) return false;
    const auto bound = [&](int p) { return static_cast<int>(static_cast<long>(count) * p / parts); };
    (*work)(bound(part), bound(part + 1));
    if (--unfinished == 0) {
      const std::lock_guard<std::mutex> lock(mutex);
      done.notify_one();
    }
    return true;
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
    unfinished = parts;
    for (int t = 0; t < threads(); ++t)
      shares[t].put(round + 1, parts * t / threads(), parts * (t + 1) / threads());
    wake_workers();
  }

  void wake_workers() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ++round;
    }
    start.notify_all();
  }

  void loop(int thread) {
    const FlushSubnormals flush;
    for (std::uint64_t seen = 0;;) {
      wait(start, [&] { return round != seen; });
      seen = round;
      if (stop) return;
      while (run_part(thread)) continue;
    }
  }
};

ThreadPool::ThreadPool(int threads)
    : state_(std::make_unique<State>(
          threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency())))) {
  for (int thread = 1; thread < state_->threads(); ++thread)
    state_->workers.emplace_back([state = state_.get(), thread] { state->loop(thread); });
}

ThreadPool::~ThreadPool() {
  state_->stop = true;
  state_->wake_workers();
  for (std::thread& worker : state_->workers) worker.join();
}

void ThreadPool::for_range(int count, int grain, const std::function<void(int, int)>& work) {
  const FlushSubnormals flush;
  const int threads = state_->threads();
  const int parts = std::min(threads * kPartsPerThread, count / std::max(1, grain));
  if (threads == 1 || parts <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  state_->work = &work;
  state_->count = count;
  state_->parts = parts;
  state_->begin_round();
  while (state_->run_part(0)) continue;
  state_->wait(state_->done, [&] { return state_->unfinished == 0; });
}

}  // namespace cfem_cutting
