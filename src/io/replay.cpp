#include "cfem_cutting/io/replay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/io/outputs.h"
#include "cfem_cutting/io/summary.h"
#include "cfem_cutting/simulation/timeline.h"
#include "progress.h"
#include "stop_signals.h"

namespace cfem_cutting {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<std::string> followed_frames(const TissueConfig& tissue) {
  std::vector<std::string> frames;
  for (const GripConfig& grip : tissue.fixed)
    if (!grip.follow.empty() && std::find(frames.begin(), frames.end(), grip.follow) == frames.end())
      frames.push_back(grip.follow);
  return frames;
}

Recording read_tool(const ReplayOptions& options, const BagReader& read_bag, const TissueConfig& tissue) {
  if (!options.poses.empty()) return {read_poses_csv(options.poses), {}, {}};
  if (options.bag.empty()) return {};
  if (!read_bag) throw FileError(options.bag + ": this program was built without ROS and reads no bags");
  std::vector<std::string> frames = followed_frames(tissue);
  const auto has_file = [&](const std::string& frame) { return options.follow.count(frame) > 0; };
  frames.erase(std::remove_if(frames.begin(), frames.end(), has_file), frames.end());
  return read_bag({options.bag, options.topic, tissue.frame, frames});
}

Recording read_recording(const ReplayOptions& options, const BagReader& read_bag,
                         const TissueConfig& tissue) {
  Recording recording = read_tool(options, read_bag, tissue);
  const std::vector<std::string> frames = followed_frames(tissue);
  for (const auto& [frame, file] : options.follow) {
    if (std::find(frames.begin(), frames.end(), frame) == frames.end())
      throw ConfigError("--follow " + frame + ": no region of tissue.fixed follows this frame");
    recording.frames[frame] = read_poses_csv(file);
  }
  for (const std::string& frame : frames)
    if (recording.frames[frame].empty())
      recording.warnings.push_back("tissue.fixed: follow: " + frame +
                                   ": there are no poses; the region stays");
  return recording;
}

/// A blade that is never placed: without a tool none has to be configured.
Blade idle_blade() { return make_blade({Vec3::Zero(), 0.01 * Vec3::UnitX()}, Vec3::UnitZ(), 0.0); }

/// The steps of a run, one after the other.
class StepSource {
 public:
  StepSource(const Recording& recording, const Simulation& simulation, double duration)
      : recording_(recording),
        time_step_(simulation.config().dynamics.time_step),
        timeline_(time_step_, [&](const Pose& a, const Pose& b) { return simulation.is_jump(a, b); }),
        idle_steps_(std::llround(duration / time_step_)) {}

  std::optional<StepInput> next() {
    std::optional<StepInput> input = recording_.tool.empty() ? next_idle() : next_with_tool();
    if (input) add_grips(*input);
    return input;
  }

  std::uint64_t jumps() const { return timeline_.jumps(); }

  double length() const {
    if (recording_.tool.empty()) return static_cast<double>(idle_steps_) * time_step_;
    return recording_.tool.back().time - recording_.tool.front().time;
  }

 private:
  std::optional<StepInput> next_idle() {
    if (step_ == idle_steps_) return std::nullopt;
    StepInput input;
    input.time = static_cast<double>(++step_) * time_step_;
    return input;
  }

  std::optional<StepInput> next_with_tool() {
    std::optional<StepInput> input = timeline_.next();
    for (; !input && pushed_ < recording_.tool.size(); input = timeline_.next())
      push(recording_.tool[pushed_++]);
    return input;
  }

  /// Time that runs backwards starts a new timeline; a stamp given twice is left out.
  void push(const StampedPose& pose) {
    if (pushed_ > 1 && pose.time < recording_.tool[pushed_ - 2].time) timeline_.restart();
    timeline_.push(pose.time, pose.pose);
  }

  void add_grips(StepInput& input) const {
    for (const auto& [frame, track] : recording_.frames)
      if (!track.empty() && input.time >= track.front().time) input.grips[frame] = pose_at(track, input.time);
  }

  const Recording& recording_;
  double time_step_;
  Timeline timeline_;
  std::int64_t idle_steps_;
  std::int64_t step_ = 0;
  std::size_t pushed_ = 0;
};

/// surface_0000.ply, … at an interval of simulated time.
class SurfaceSeries {
 public:
  SurfaceSeries(const OutputFolder& folder, double interval, double time_step)
      : folder_(folder),
        every_(std::max<std::int64_t>(1, std::llround(interval / time_step))),
        on_(interval > 0) {}

  void add(const Simulation& simulation) {
    if (!on_ || ++step_ % every_ != 0) return;
    char name[32];
    std::snprintf(name, sizeof(name), "surface_%04d.ply", written_++);
    write_deformed_surface(folder_, name, simulation);
  }

 private:
  const OutputFolder& folder_;
  std::int64_t every_, step_ = 0;
  int written_ = 0;
  bool on_;
};

struct RunFigures {
  RunStatistics statistics;
  TimingTable timing;
  double wall_time = 0.0;  // s
  int stopped_by = 0;      // the signal that ended the run, 0: none
};

RunFigures run_steps(Simulation& simulation, StepSource& steps, const OutputFolder& folder,
                     double surface_every) {
  const SimulationConfig& config = simulation.config();
  RunFigures figures;
  RunTables tables(folder, config.probes.size());
  SurfaceSeries surfaces(folder, surface_every, config.dynamics.time_step);
  Progress progress(steps.length());
  const Clock::time_point start = Clock::now();
  while (const std::optional<StepInput> input = steps.next()) {
    figures.stopped_by = StopSignals::caught();
    if (figures.stopped_by != 0) break;
    const Clock::time_point step_start = Clock::now();
    const StepReport report = simulation.step(*input);
    figures.timing.add(report, milliseconds_since(step_start));
    const FrontFidelity front = simulation.front_fidelity();
    figures.statistics.add(report, front, simulation.front().points);
    tables.add(report, front, simulation.probe_displacements());
    surfaces.add(simulation);
    progress.show(figures.statistics.steps * config.dynamics.time_step);
  }
  figures.wall_time = 1e-3 * milliseconds_since(start);
  tables.close();
  return figures;
}

/// Says them, and keeps them for the summary.
void warn(const std::vector<std::string>& warnings, std::vector<std::string>& kept) {
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << std::endl;
  kept.insert(kept.end(), warnings.begin(), warnings.end());
}

std::vector<std::string> jump_warnings(std::uint64_t jumps) {
  if (jumps == 0) return {};
  return {std::to_string(jumps) +
          " pose(s) are farther than blade.max_travel from the one before: nothing is cut there"};
}

void write_results(const OutputFolder& folder, const Simulation& simulation, const RunFigures& figures,
                   const std::vector<std::string>& warnings) {
  write_links(folder, simulation.volume());
  write_deformed_surface(folder, "surface_final.ply", simulation);
  write_rest_surface(folder, "surface_rest.ply", simulation);
  figures.timing.write(folder);
  write_timing(folder, figures.wall_time, figures.timing.steps());
  write_summary(folder, simulation, figures.statistics, warnings);
}

/// What was written stays, for who wants to look at it.
[[noreturn]] void stop(OutputFolder& folder, const RunFigures& figures) {
  const std::string signal = figures.stopped_by == SIGINT ? "SIGINT" : "SIGTERM";
  throw Stopped(figures.stopped_by, "stopped by " + signal + " after " +
                                        std::to_string(figures.statistics.steps) + " steps: the results in " +
                                        folder.keep() + " are incomplete");
}

}  // namespace

void run_replay(const ReplayOptions& options, const BagReader& read_bag) {
  const SimulationConfig config = read_config_file(options.config, options.overrides).simulation;
  const PathResolver resolve = make_path_resolver(options.config);
  const bool has_tool = options.duration == 0.0;
  const bool has_blade = !config.blade.edge.empty() || !config.blade.edge_links.empty();
  const Blade blade = has_tool || has_blade ? load_blade(config.blade, resolve) : idle_blade();
  const Recording recording = read_recording(options, read_bag, config.tissue);
  OutputFolder folder(options.out);
  Simulation simulation(config, *load_shape(config.tissue, resolve), blade);
  const StopSignals stop_signals;
  std::vector<std::string> warnings;
  warn(recording.warnings, warnings);
  warn(simulation.warnings(), warnings);
  StepSource steps(recording, simulation, options.duration);
  const RunFigures figures = run_steps(simulation, steps, folder, options.surface_every);
  if (figures.stopped_by != 0) stop(folder, figures);
  warn(jump_warnings(steps.jumps()), warnings);
  warn(run_warnings(figures.statistics), warnings);
  if (has_tool) warn(miss_warnings(figures.statistics, simulation.surface()), warnings);
  write_results(folder, simulation, figures, warnings);
  folder.publish();
  std::cout << figures.statistics.steps << " steps in " << figures.wall_time << " s, "
            << figures.statistics.fracture_events << " fractures; results are in " << options.out
            << std::endl;
}

}  // namespace cfem_cutting
