#include "stop_signals.h"

namespace cfem_cutting {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int number) {
  caught_signal = number;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

/// A signal that is ignored, as in the background of a script, stays so.
void install(int number, const struct sigaction& action, struct sigaction& before) {
  sigaction(number, &action, &before);
  if (before.sa_handler == SIG_IGN) sigaction(number, &before, nullptr);
}

}  // namespace

StopSignals::StopSignals() {
  caught_signal = 0;
  struct sigaction action {};
  action.sa_handler = catch_signal;
  install(SIGINT, action, before_interrupt_);
  install(SIGTERM, action, before_terminate_);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &before_interrupt_, nullptr);
  sigaction(SIGTERM, &before_terminate_, nullptr);
}

int StopSignals::caught() { return caught_signal; }

}  // namespace cfem_cutting
