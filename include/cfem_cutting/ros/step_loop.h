#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/ros/scene_publisher.h"
#include "cfem_cutting/ros/step_publisher.h"
#include "cfem_cutting/ros/tool_tracker.h"
#include "cfem_cutting/simulation/timeline.h"

namespace cfem_cutting {

enum class OperatingState { kEnabled, kPaused, kFault };
const char* name_of(OperatingState state);

/// How the loop is doing, for diagnostics.
struct LoopStatus {
  OperatingState state = OperatingState::kEnabled;
  std::string fault;  ///< what went wrong
  std::uint64_t steps = 0;
  std::uint64_t events = 0;  ///< since the last reset
  double lag = 0.0;          ///< s
  double skipped = 0.0;      ///< s
  bool stale = true;         ///< no pose for longer than node.input_timeout
  int inverted_elements = 0;
  std::uint64_t not_converged = 0;  ///< steps
  std::uint64_t jumps = 0;          ///< poses farther than blade.max_travel from the one before
};

/// Owns the simulation and steps it in a thread of its own, by the poses' stamps. Everything that touches the
/// simulation runs in that thread.
class StepLoop {
 public:
  StepLoop(const Config& config, std::unique_ptr<Simulation> simulation, ToolTracker& tracker,
           StepPublisher& steps, ScenePublisher& scenes);
  ~StepLoop();

  /// Runs a task between two steps and waits for it.
  /// @return false if the loop has stopped
  /// @throw what the task throws
  bool run_between_steps(const std::function<void(Simulation&)>& task);

  bool pause();
  /// @return false in a fault, which only a reset ends
  bool resume();
  /// Back to the uncut rest shape; ends a fault.
  bool reset();

  /// Asks the loop to end after the step that runs now.
  void request_stop() { stopping_ = true; }
  bool stopped() const { return stopped_; }

  LoopStatus status() const;
  std::vector<FractureEventMessage> events() const;
  double time() const { return time_; }  ///< s, the end of the last step

 private:
  void run();
  void cycle();
  void run_tasks();
  bool feed_and_step();
  void feed(const ReceivedPose& pose);
  std::optional<StepInput> next_input();
  std::optional<StepInput> held_input();
  bool wait_for_grips(double time);
  void step(StepInput input);
  void record(const StepReport& report);
  void watch_input();
  double input_time() const;
  void show(bool changed);
  void set_state(OperatingState state, const std::string& fault = "");
  void forget();
  void start_timeline_anew();

  Config config_;
  std::unique_ptr<Simulation> simulation_;
  Timeline timeline_;
  ToolTracker& tracker_;
  StepPublisher& step_publisher_;
  ScenePublisher& scene_publisher_;
  StepReport last_;
  double newest_ = 0.0;             // s, the last pose's stamp
  bool held_steps_wanted_ = false;  // a pose has come since the input was stale
  std::chrono::steady_clock::time_point last_step_, last_zero_;
  std::optional<std::chrono::steady_clock::time_point> grips_wanted_;
  std::optional<StepInput> pending_;  // waits for the transforms of its grips

  mutable std::mutex mutex_;  // of what follows
  LoopStatus status_;
  std::vector<FractureEventMessage> events_;
  std::deque<std::packaged_task<void()>> tasks_;

  std::atomic<double> time_{0.0};
  std::atomic<bool> stopping_{false}, stopped_{false};
  std::thread thread_;
};

}  // namespace cfem_cutting
