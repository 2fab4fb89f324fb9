#include "stop_signals.h"

namespace cfem_cutting {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int number) { caught_signal = number; }

}  // namespace

StopSignals::StopSignals() {
  caught_signal = 0;
  struct sigaction action {};
  action.sa_handler = catch_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &before_interrupt_);
  sigaction(SIGTERM, &action, &before_terminate_);
}

StopSignals::~StopSignals() {
  sigaction(SIGINT, &before_interrupt_, nullptr);
  sigaction(SIGTERM, &before_terminate_, nullptr);
}

int StopSignals::caught() { return caught_signal; }

}  // namespace cfem_cutting
