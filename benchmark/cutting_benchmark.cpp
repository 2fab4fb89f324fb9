// Steps of the whole simulation while it cuts. The liver's data come with scripts/fetch_data; a box needs
// none.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/io/tool_path.h"
#include "cfem_cutting/simulation/simulation.h"
#include "yardstick.h"

namespace cfem_cutting {
namespace {

void run(benchmark::State& state, SimulationConfig config, const Shape& shape, const Blade& blade,
         const ToolPath& path) {
  config.dynamics.solver.threads = static_cast<int>(state.range(0));
  Simulation simulation(config, shape, blade);
  const double dt = config.dynamics.time_step;
  double iterations = 0.0, time = 0.0;
  std::map<std::string, double> stages;  // ms, in all
  for (auto _ : state) {
    StepInput input;
    input.time = (time += dt);
    input.path = {path.at(time)};
    const StepReport report = simulation.step(input);
    iterations += report.iterations;
    for (const StageTime& stage : report.stages) stages[stage.stage] += stage.milliseconds;
    benchmark::DoNotOptimize(simulation.deformed_surface());
  }
  state.counters["voxels"] = static_cast<double>(simulation.volume().voxels().size());
  state.counters["elements"] = static_cast<double>(simulation.model().mesh().elements().size());
  state.counters["links_severed"] = static_cast<double>(simulation.volume().severed_count());
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
  const double per_yardstick =
      1e-3 / yardstick() / static_cast<double>(state.iterations()) / state.counters["elements"].value;
  for (const auto& [stage, milliseconds] : stages)
    state.counters["yardsticks, " + stage] = milliseconds * per_yardstick;
  state.counters["steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// A slice through the middle of a box of 10 × 10 × 5 cm, held at its base.
void box(benchmark::State& state) {
  SimulationConfig config;
  config.tissue.voxel_size = Vec3::Constant(0.0025);
  config.tissue.fixed.resize(1);
  config.tissue.fixed[0].box = Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001));
  const ToolPath slice(YAML::Load("{frame: blade, waypoints: [{t: 0, xyz: [0.02, 0.051, 0.052]}, "
                                  "{t: 1, xyz: [0.02, 0.051, 0.035]}, {t: 3, xyz: [0.06, 0.051, 0.025]}]}"),
                       "slice");
  run(state, config, *make_box(config.tissue.box_size, Pose::Identity()),
      make_blade({Vec3::Zero(), Vec3(0.028, 0, 0)}, Vec3::UnitZ(), 0.0), slice);
}
BENCHMARK(box)->Arg(1)->Arg(2)->Iterations(300)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The recorded incision of the demo.
void liver(benchmark::State& state) {
  const std::string folder = std::string(CFEM_CUTTING_SOURCE_DIR) + "/config";
  const Config config = read_config_file(folder + "/liver.yaml", {});
  const PathResolver resolve = make_path_resolver(folder + "/liver.yaml");
  if (!std::filesystem::exists(resolve(config.simulation.tissue.source))) {
    state.SkipWithError("no liver: run scripts/fetch_data");
    return;
  }
  run(state, config.simulation, *load_shape(config.simulation.tissue, resolve),
      load_blade(config.simulation.blade, resolve),
      read_tool_paths(folder + "/paths/liver_incision.yaml").tool);
}
BENCHMARK(liver)->Arg(1)->Arg(2)->Iterations(600)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cfem_cutting

BENCHMARK_MAIN();
