#include "cfem_cutting/ros/pose_queue.h"

#include <limits>

namespace cfem_cutting {
namespace {
constexpr std::size_t kPosesOfAJump = 3;  // as many in a row behind the others: time ran backwards
}

void PoseQueue::push(ReceivedPose pose) {
  const std::lock_guard lock(mutex_);
  ++counts_.received;
  if (pose.stamp.isZero()) {
    ++counts_.no_stamp;
    return;
  }
  if (pose.stamp == newest_) {
    ++counts_.out_of_order;
    return;
  }
  if (pose.stamp > newest_) {
    counts_.out_of_order += behind_.size();
    behind_.clear();
    accept(std::move(pose));
  } else {
    hold_back(std::move(pose));
  }
}

void PoseQueue::hold_back(ReceivedPose pose) {
  if (!behind_.empty() && pose.stamp <= behind_.back().stamp) {
    counts_.out_of_order += behind_.size();
    behind_.clear();
  }
  behind_.push_back(std::move(pose));
  if (behind_.size() < kPosesOfAJump) return;
  ++counts_.time_jumps;
  behind_.front().after_jump = true;
  for (ReceivedPose& kept : behind_) accept(std::move(kept));
  behind_.clear();
}

void PoseQueue::accept(ReceivedPose pose) {
  if (waiting_.size() >= capacity_) thin(waiting_);
  newest_ = pose.stamp;
  waiting_.push_back(std::move(pose));
}

void PoseQueue::thin(std::deque<ReceivedPose>& poses) {
  std::deque<ReceivedPose> kept;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % 2 == 0 || poses[i].after_jump) kept.push_back(std::move(poses[i]));
  }
  counts_.thinned += poses.size() - kept.size();
  poses = std::move(kept);
}

void PoseQueue::place(const std::function<Placing(ReceivedPose&)>& attempt) {
  const std::lock_guard lock(mutex_);
  while (!waiting_.empty()) {
    ReceivedPose& pose = waiting_.front();
    const Placing result = attempt(pose);
    if (result == Placing::kWait) return;
    if (result == Placing::kPlaced) {
      if (placed_.size() >= capacity_) thin(placed_);
      placed_.push_back(std::move(pose));
      waiting_.pop_front();
      last_placing_ = std::chrono::steady_clock::now();
      continue;
    }
    ++counts_.no_transform;
    const bool jump_is_due = pose.after_jump;
    waiting_.pop_front();
    if (jump_is_due && !waiting_.empty()) waiting_.front().after_jump = true;
  }
}

std::optional<ReceivedPose> PoseQueue::take() {
  const std::lock_guard lock(mutex_);
  if (placed_.empty()) return std::nullopt;
  ReceivedPose pose = std::move(placed_.front());
  placed_.pop_front();
  ++counts_.used;
  return pose;
}

void PoseQueue::count_invalid() {
  const std::lock_guard lock(mutex_);
  ++counts_.received;
  ++counts_.invalid;
}

void PoseQueue::clear() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  placed_.clear();
}

bool PoseQueue::has_placed() const {
  const std::lock_guard lock(mutex_);
  return !placed_.empty();
}

double PoseQueue::newest_stamp() const {
  const std::lock_guard lock(mutex_);
  return newest_.toSec();
}

PoseCounts PoseQueue::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

double PoseQueue::silence() const {
  const std::lock_guard lock(mutex_);
  if (!last_placing_) return std::numeric_limits<double>::infinity();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - *last_placing_).count();
}

}  // namespace cfem_cutting
