#include "cfem_cutting/ros/step_loop.h"

#include <ros/console.h>

#include <algorithm>

#include "cfem_cutting/ros/conversions.h"

namespace cfem_cutting {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWarnEvery = 10.0;                   // s, on the console
constexpr double kZeroEvery = 0.1;                    // s, of zero wrenches while the input is stale
constexpr auto kIdle = std::chrono::milliseconds(1);  // between two looks at an empty queue

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

const char* name_of(OperatingState state) {
  switch (state) {
    case OperatingState::kEnabled:
      return "ENABLED";
    case OperatingState::kPaused:
      return "PAUSED";
    default:
      return "FAULT";
  }
}

StepLoop::StepLoop(const Config& config, std::unique_ptr<Simulation> simulation, ToolTracker& tracker,
                   StepPublisher& steps, ScenePublisher& scenes)
    : config_(config),
      simulation_(std::move(simulation)),
      timeline_(config.simulation.dynamics.time_step,
                [this](const Pose& a, const Pose& b) { return simulation_->is_jump(a, b); }),
      tracker_(tracker),
      step_publisher_(steps),
      scene_publisher_(scenes) {
  step_publisher_.publish_state(name_of(status_.state));
  thread_ = std::thread([this] { run(); });
}

StepLoop::~StepLoop() {
  request_stop();
  thread_.join();
}

void StepLoop::run() {
  while (!stopping_) {
    try {
      cycle();
    } catch (const std::exception& error) {
      ROS_ERROR("Stopped cutting: %s (~reset starts anew)", error.what());
      set_state(OperatingState::kFault, error.what());
    }
  }
  stopped_ = true;
}

void StepLoop::cycle() {
  run_tasks();
  bool stepped = false;
  if (status().state == OperatingState::kEnabled) {
    stepped = feed_and_step();
    watch_input();
  } else {
    tracker_.clear();
  }
  if (status().state != OperatingState::kFault) show(stepped);
  if (!stepped) std::this_thread::sleep_for(kIdle);
}

bool StepLoop::feed_and_step() {
  std::optional<StepInput> input = std::exchange(pending_, std::nullopt);
  if (!input) input = next_input();
  if (!input) input = held_input();
  if (!input) return false;
  if (wait_for_grips(input->time)) {
    pending_ = std::move(input);
    return false;
  }
  step(std::move(*input));
  return true;
}

// Lossless: one pose at a time, so that the queue holds what the simulation has not come to. Real time: all
// there are.
std::optional<StepInput> StepLoop::next_input() {
  const bool lossless = config_.node.timing == Timing::kLossless;
  std::optional<StepInput> input;
  if (lossless) input = timeline_.next();
  while (!input) {
    std::optional<ReceivedPose> pose = tracker_.take();
    if (!pose) break;
    feed(*pose);
    if (lossless) input = timeline_.next();
  }
  if (lossless || input) return input;
  if (timeline_.lag() <= config_.node.max_lag) return timeline_.next();
  double skipped = 0.0;
  input = timeline_.catch_up(skipped);
  ROS_WARN_THROTTLE(kWarnEvery, "Slower than real time: %.2f s were left out so far (node.timing: realtime)",
                    status().skipped + skipped);
  const std::lock_guard lock(mutex_);
  status_.skipped += skipped;
  return input;
}

void StepLoop::feed(const ReceivedPose& pose) {
  if (pose.after_jump) {
    ROS_WARN("Time ran backwards: the blade's front is set anew");
    if (config_.node.reset_on_loop) forget();
    timeline_.restart();
  }
  // Poses come again: the time without them was not left out, as there was nothing to do.
  if (config_.node.timing == Timing::kRealtime && status().stale && timeline_.is_gap(pose.stamp.toSec()))
    timeline_.restart();
  newest_ = pose.stamp.toSec();
  held_steps_wanted_ = true;
  timeline_.push(newest_, pose.pose);
}

// Real time: when poses stop the blade is held where it is, step by step, until the input counts as stale.
std::optional<StepInput> StepLoop::held_input() {
  if (config_.node.timing != Timing::kRealtime || !held_steps_wanted_) return std::nullopt;
  const double silence = tracker_.silence();
  const double time_step = config_.simulation.dynamics.time_step;
  if (silence < std::max(config_.node.max_lag, 2 * time_step) || seconds_since(last_step_) < time_step) {
    return std::nullopt;
  }
  if (silence > config_.node.input_timeout) {
    held_steps_wanted_ = false;
    return std::nullopt;
  }
  return timeline_.hold();
}

bool StepLoop::wait_for_grips(double time) {
  if (config_.node.timing != Timing::kLossless || !tracker_.grips_are_late(time)) {
    grips_wanted_.reset();
    return false;
  }
  if (!grips_wanted_) grips_wanted_ = Clock::now();
  return seconds_since(*grips_wanted_) < tracker_.patience();
}

void StepLoop::step(StepInput input) {
  input.grips = tracker_.grips(input.time);
  const StepReport report = simulation_->step(input);
  last_step_ = Clock::now();
  record(report);
  const LoopStatus now = status();
  step_publisher_.publish(report, now.lag, now.skipped);
  last_ = report;
}

void StepLoop::record(const StepReport& report) {
  time_ = report.time;
  const std::lock_guard lock(mutex_);
  ++status_.steps;
  status_.events += report.events.size();
  status_.lag = std::max(0.0, std::max(newest_, tracker_.newest_stamp()) - report.time);
  status_.inverted_elements = report.inverted_elements;
  if (!report.converged) ++status_.not_converged;
  status_.stale = false;
  status_.jumps = timeline_.jumps();
  for (const FractureEvent& event : report.events) {
    events_.push_back(to_message(event, config_.simulation.tissue.frame));
  }
}

/// Now, on the input's clock, s.
double StepLoop::input_time() const {
  return last_step_ == Clock::time_point{} ? time_.load() : time_ + seconds_since(last_step_);
}

void StepLoop::watch_input() {
  if (tracker_.counts().received == 0)
    ROS_WARN_DELAYED_THROTTLE(kWarnEvery, "No pose has come yet: waiting for %s", tracker_.source().c_str());
  if (tracker_.silence() <= config_.node.input_timeout || tracker_.has_poses() || pending_) return;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(status_.stale, true) && seconds_since(last_zero_) < kZeroEvery) return;
  }
  last_zero_ = Clock::now();
  step_publisher_.publish_zero_wrench(input_time());
}

void StepLoop::show(bool changed) {
  if (scene_publisher_.wants(changed)) scene_publisher_.offer(take_scene(*simulation_, last_));
}

void StepLoop::set_state(OperatingState state, const std::string& fault) {
  {
    const std::lock_guard lock(mutex_);
    status_.state = state;
    status_.fault = fault;
  }
  if (state != OperatingState::kEnabled) step_publisher_.publish_zero_wrench(input_time());
  step_publisher_.publish_state(name_of(state));
}

// The uncut rest shape again.
void StepLoop::forget() {
  simulation_->reset();
  last_ = StepReport{};
  last_.time = time_;
  const std::lock_guard lock(mutex_);
  events_.clear();
  status_.events = 0;
  status_.skipped = 0.0;
}

bool StepLoop::reset() {
  return run_between_steps([this](Simulation&) {
    const bool paused = status().state == OperatingState::kPaused;
    forget();
    start_timeline_anew();
    set_state(paused ? OperatingState::kPaused : OperatingState::kEnabled);
    scene_publisher_.wake();
  });
}

void StepLoop::start_timeline_anew() {
  tracker_.clear();
  timeline_.restart();
  pending_.reset();
  held_steps_wanted_ = false;
}

bool StepLoop::pause() {
  return run_between_steps([this](Simulation&) {
    if (status().state == OperatingState::kEnabled) set_state(OperatingState::kPaused);
  });
}

bool StepLoop::resume() {
  bool enabled = false;
  run_between_steps([&, this](Simulation&) {
    const OperatingState state = status().state;
    enabled = state != OperatingState::kFault;
    if (state != OperatingState::kPaused) return;
    start_timeline_anew();
    set_state(OperatingState::kEnabled);
  });
  return enabled;
}

bool StepLoop::run_between_steps(const std::function<void(Simulation&)>& task) {
  std::packaged_task<void()> packaged([this, task] { task(*simulation_); });
  std::future<void> done = packaged.get_future();
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(packaged));
  }
  while (done.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready) {
    if (stopped_) return false;
  }
  done.get();
  return true;
}

void StepLoop::run_tasks() {
  while (true) {
    std::packaged_task<void()> task;
    {
      const std::lock_guard lock(mutex_);
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

LoopStatus StepLoop::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::vector<FractureEventMessage> StepLoop::events() const {
  const std::lock_guard lock(mutex_);
  return events_;
}

}  // namespace cfem_cutting
