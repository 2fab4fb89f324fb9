#include "cfem_cutting/simulation/timeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cfem_cutting {
namespace {

/// s, between two poses; a longer one is a jump, not steps to be taken.
constexpr double kLongestGap = 60.0;

/// Steps: stamps so near to a multiple of the time step are on it. Stamps since 1970 are known to 2e-7 s
/// only.
double tolerance(double time, double time_step) {
  return 1e-9 + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(time) / time_step;
}

std::int64_t first_multiple_from(double time, double time_step) {
  return std::llround(std::ceil(time / time_step - tolerance(time, time_step)));
}

std::int64_t last_multiple_until(double time, double time_step) {
  return std::llround(std::floor(time / time_step + tolerance(time, time_step)));
}

}  // namespace

Timeline::Timeline(double time_step, IsJump is_jump, double max_gap)
    : time_step_(time_step), is_jump_(std::move(is_jump)), max_gap_(max_gap) {}

bool Timeline::push(double stamp, const Pose& X_TB) {
  if (!std::isfinite(stamp)) return false;
  if (!poses_.empty() && stamp <= poses_.back().time) return false;
  if (!poses_.empty() && stamp - poses_.back().time > kLongestGap) restart();
  const bool jump = !poses_.empty() && is_jump_ && is_jump_(poses_.back().X_TB, X_TB);
  if (jump) ++jumps_;
  const bool after_gap = jump || is_gap(stamp);
  poses_.push_back({stamp, X_TB, after_gap});
  return true;
}

std::optional<StepInput> Timeline::next() {
  if (poses_.empty()) return std::nullopt;
  const std::int64_t end = started_ ? step_ + 1 : first_multiple_from(poses_.front().time, time_step_);
  if (end > last_multiple_until(poses_.back().time, time_step_)) return std::nullopt;
  return step_to(end);
}

std::optional<StepInput> Timeline::catch_up(double& skipped) {
  if (poses_.empty()) return std::nullopt;
  const std::int64_t next_end = started_ ? step_ + 1 : first_multiple_from(poses_.front().time, time_step_);
  const std::int64_t end = last_multiple_until(poses_.back().time, time_step_);
  if (end < next_end) return std::nullopt;
  skipped += static_cast<double>(end - next_end) * time_step_;
  return step_to(end);
}

StepInput Timeline::hold() {
  if (!poses_.empty())
    return step_to(started_ ? step_ + 1 : first_multiple_from(poses_.back().time, time_step_));
  StepInput input;
  input.time = static_cast<double>(++step_) * time_step_;
  return input;
}

double Timeline::lag() const {
  if (poses_.empty() || !started_) return 0.0;
  return std::max(0.0, poses_.back().time - static_cast<double>(step_) * time_step_);
}

void Timeline::restart() {
  poses_.clear();
  started_ = false;
  front_anew_ = true;
}

StepInput Timeline::step_to(std::int64_t end) {
  StepInput input;
  input.time = static_cast<double>(end) * time_step_;
  if (!started_) begin(input);
  const double slack = tolerance(input.time, time_step_) * time_step_;
  while (poses_.size() > 1 && poses_[1].time <= input.time + slack) {
    if (poses_[1].after_gap) {
      input.path.clear();
      front_anew_ = true;
    }
    input.path.push_back(poses_[1].X_TB);
    poses_.pop_front();
  }
  if (input.path.empty() || std::abs(poses_.front().time - input.time) > slack)
    input.path.push_back(at(input.time));
  input.front_anew = std::exchange(front_anew_, false);
  step_ = end;
  return input;
}

void Timeline::begin(StepInput& input) {
  started_ = true;
  const double time = static_cast<double>(first_multiple_from(poses_.front().time, time_step_)) * time_step_;
  const double slack = tolerance(time, time_step_) * time_step_;
  while (poses_.size() > 1 && poses_[1].time <= time + slack) poses_.pop_front();
  if (time < input.time - slack) input.path.push_back(at(time));
}

Pose Timeline::at(double time) const {
  const Stamped& a = poses_.front();
  if (poses_.size() == 1 || time <= a.time || poses_[1].after_gap) return a.X_TB;
  const Stamped& b = poses_[1];
  return interpolate(a.X_TB, b.X_TB, std::min(1.0, (time - a.time) / (b.time - a.time)));
}

}  // namespace cfem_cutting
