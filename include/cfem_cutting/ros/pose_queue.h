#pragma once

#include <ros/time.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// A pose as it came in; placed once tf has brought it to the tissue frame.
struct ReceivedPose {
  ros::Time stamp;
  std::string frame;  ///< F of `pose`: as in the message, then the tissue frame's
  Pose pose;          ///< X_FB, of the tool in that frame
  std::chrono::steady_clock::time_point arrival;
  bool after_jump = false;  ///< time ran backwards before this pose
};

/// What became of the poses, for diagnostics.
struct PoseCounts {
  std::uint64_t received = 0;
  std::uint64_t used = 0;
  std::uint64_t invalid = 0;       ///< not finite, absurdly far away, or no unit quaternion
  std::uint64_t no_stamp = 0;      ///< stamp zero: invalid by CRTK's convention
  std::uint64_t out_of_order = 0;  ///< not later than the pose before
  std::uint64_t no_transform = 0;  ///< tf could not bring them to the tissue frame in time
  std::uint64_t thinned = 0;       ///< left out of a queue that was full, between two that were kept
  std::uint64_t time_jumps = 0;    ///< backwards
};

/// Poses that wait for the simulation, in the order of their stamps. Thread-safe and bounded: when it is full
/// every second pose is left out, so the path stays.
///
/// A single pose behind the others is out of order; a few in a row, each later than the last, mean that time
/// itself ran backwards (a bag that is played again), and they are kept.
class PoseQueue {
 public:
  explicit PoseQueue(std::size_t capacity = 200000) : capacity_(capacity) {}

  void push(ReceivedPose pose);
  void count_invalid();

  /// What became of an attempt to bring a pose to the tissue frame.
  enum class Placing { kPlaced, kWait, kGiveUp };

  /// Places the poses that wait for it, in order, up to the first that has to wait on; drops those given up.
  void place(const std::function<Placing(ReceivedPose&)>& attempt);

  /// Takes out the first pose, if it is placed.
  std::optional<ReceivedPose> take();

  /// Forgets the poses that wait; counts and order stay.
  void clear();

  bool has_placed() const;
  double newest_stamp() const;  ///< s, zero before the first pose
  PoseCounts counts() const;

  /// Time since a pose was placed, s; infinite before the first.
  double silence() const;

 private:
  void accept(ReceivedPose pose);
  void hold_back(ReceivedPose pose);
  void thin(std::deque<ReceivedPose>& poses);

  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::deque<ReceivedPose> waiting_;  // for tf
  std::deque<ReceivedPose> placed_;
  std::deque<ReceivedPose> behind_;  // in order, but before `newest_`
  ros::Time newest_;
  std::optional<std::chrono::steady_clock::time_point> last_placing_;
  PoseCounts counts_;
};

}  // namespace cfem_cutting
