#include "thread_pool.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace cfem_cutting {

struct ThreadPool::State {
  std::mutex mutex;
  std::condition_variable start, done;
  std::vector<std::thread> workers;
  const std::function<void(int, int)>* work = nullptr;
  int count = 0, parts = 0;
  int pending = 0;  // workers that have not finished this round
  long round = 0;
  bool stop = false;

  void run_part(int part) const {
    const auto bound = [&](int p) { return static_cast<int>(static_cast<long>(count) * p / parts); };
    (*work)(bound(part), bound(part + 1));
  }

  void loop(int part) {
    long seen = 0;
    std::unique_lock<std::mutex> lock(mutex);
    while (true) {
      start.wait(lock, [&] { return stop || round != seen; });
      if (stop) return;
      seen = round;
      if (part >= parts) continue;
      lock.unlock();
      run_part(part);
      lock.lock();
      if (--pending == 0) done.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) : state_(std::make_unique<State>()) {
  if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int part = 1; part < threads; ++part)
    state_->workers.emplace_back([state = state_.get(), part] { state->loop(part); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->stop = true;
  }
  state_->start.notify_all();
  for (std::thread& worker : state_->workers) worker.join();
}

void ThreadPool::for_range(int count, int grain, const std::function<void(int, int)>& work) {
  const int parts = std::min(static_cast<int>(state_->workers.size()) + 1, count / std::max(1, grain));
  if (parts <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->work = &work;
    state_->count = count;
    state_->parts = parts;
    state_->pending = parts - 1;
    ++state_->round;
  }
  state_->start.notify_all();
  state_->run_part(0);
  std::unique_lock<std::mutex> lock(state_->mutex);
  state_->done.wait(lock, [&] { return state_->pending == 0; });
}

}  // namespace cfem_cutting
