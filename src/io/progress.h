#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace cfem_cutting {

/// One line on standard error that counts up, if that is a terminal.
class Progress {
 public:
  explicit Progress(double end) : end_(end), shown_(isatty(STDERR_FILENO) == 1) {}
  ~Progress() {
    if (any_) std::fprintf(stderr, "\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done s of `end` s
  void show(double done) {
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    any_ = true;
    std::fprintf(stderr, "\r\033[K%.2f of %.2f s simulated (%.0f %%)", done, end_, 100.0 * done / end_);
    std::fflush(stderr);
  }

 private:
  double end_;
  bool shown_;
  bool any_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace cfem_cutting
