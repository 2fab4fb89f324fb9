#pragma once

#include <csignal>
#include <stdexcept>
#include <string>

namespace cfem_cutting {

/// A run was ended by a signal before it was through.
struct Stopped : std::runtime_error {
  Stopped(int signal_number, const std::string& message)
      : std::runtime_error(message), signal(signal_number) {}
  int signal;
};

/// While one lives, a SIGINT or SIGTERM is kept for the run to see between two steps. A second one ends the
/// program at once.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// The signal that came, 0 if none has.
  static int caught();

 private:
  struct sigaction before_interrupt_ {};
  struct sigaction before_terminate_ {};
};

}  // namespace cfem_cutting
