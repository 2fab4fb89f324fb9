#pragma once

#include <chrono>

#include "cfem_cutting/simulation/reports.h"

namespace cfem_cutting {

/// Writes the time since the last lap to a list.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& laps) : laps_(laps) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    laps_.push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

 private:
  std::vector<StageTime>& laps_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace cfem_cutting
