#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "cfem_cutting/simulation/simulation.h"

namespace cfem_cutting {

/// Cuts a stream of stamped tool poses into steps of equal length that end on multiples of the time step;
/// poses are interpolated at the steps' ends, and those that fall inside a step are passed on, so the result
/// does not depend on the rate of the poses. The first step ends at the first multiple from the first stamp
/// on. Within a gap the blade is held at the last pose before it; the step that reaches the gap's end starts
/// there with the front made anew; after a gap of more than a minute the stream starts anew. Used by the node
/// and offline alike.
class Timeline {
 public:
  /// @param time_step s
  /// Whether the blade goes too far from one pose to the next to have cut on the way.
  using IsJump = std::function<bool(const Pose&, const Pose&)>;

  /// @param is_jump such a pose ends a gap, too
  /// @param max_gap s, a longer time between two poses is a gap
  explicit Timeline(double time_step, IsJump is_jump = {}, double max_gap = 0.5);

  /// @return false if the stamp does not increase: the pose is not used
  bool push(double stamp, const Pose& X_TB);

  /// Whether there is no pose for so long before a stamp (s) that the front will be made anew there.
  bool is_gap(double stamp) const { return !poses_.empty() && stamp - poses_.back().time > max_gap_; }

  /// The next whole step that the poses so far cover (grips are the caller's).
  std::optional<StepInput> next();

  /// One step through all poses queued, which ends at the last multiple before the newest pose; skips
  /// simulated time.
  /// @param skipped s, added to: time that was not simulated
  std::optional<StepInput> catch_up(double& skipped);

  /// Step with the blade held where it is (no new pose).
  StepInput hold();

  /// s, from the last step's end to the newest pose.
  double lag() const;

  std::uint64_t jumps() const { return jumps_; }  ///< poses that were one

  /// Forgets all (time ran backwards): the front is set anew at the next pose.
  void restart();

 private:
  struct Stamped {
    double time;
    Pose X_TB;
    bool after_gap;
  };
  StepInput step_to(std::int64_t end);
  void begin(StepInput& input);
  Pose at(double time) const;

  double time_step_;
  IsJump is_jump_;
  double max_gap_;
  std::uint64_t jumps_ = 0;
  std::deque<Stamped> poses_;  // the last one that a step used, and all after it
  std::int64_t step_ = 0;      // the last step's end is step_ · time_step_
  bool started_ = false;
  bool front_anew_ = true;
};

}  // namespace cfem_cutting
