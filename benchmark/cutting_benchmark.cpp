// Steps of the whole simulation while it cuts. The liver's data come with scripts/fetch_data; a box needs
// none.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/simulation/simulation.h"

namespace cfem_cutting {
namespace {

constexpr double kSpeed = 0.02;  // m/s

/// Cuts from `from` along `way` over and over: a stroke of 2 s, then the next one beside it.
class Strokes {
 public:
  Strokes(Simulation& simulation, Vec3 from, Vec3 way)
      : simulation_(simulation), from_(std::move(from)), way_(way) {}

  StepReport step() {
    const double dt = simulation_.config().dynamics.time_step;
    const int steps = static_cast<int>(way_.norm() / (kSpeed * dt));
    const int stroke = count_ / steps;
    StepInput input;
    input.time = count_ * dt;
    input.front_anew = count_ % steps == 0;
    const Vec3 beside = 0.01 * stroke * Vec3::UnitY();
    const Vec3 position = from_ + beside + static_cast<double>(count_ % steps) / steps * way_;
    input.path = {Pose(Eigen::Translation3d(position))};
    ++count_;
    return simulation_.step(input);
  }

 private:
  Simulation& simulation_;
  Vec3 from_;
  Vec3 way_;
  int count_ = 0;
};

void run(benchmark::State& state, SimulationConfig config, const Shape& shape, const Blade& blade) {
  config.dynamics.solver.threads = static_cast<int>(state.range(0));
  Simulation simulation(config, shape, blade);
  const Box bounds = shape.bounds();
  // Along x through the highest middle part, from above the skin to 20 mm below it.
  const Vec3 top(bounds.center().x(), bounds.center().y(), bounds.max().z() + 0.002);
  Strokes strokes(simulation, top, Vec3(0.02, 0.0, -0.03));
  double iterations = 0.0;
  for (auto _ : state) {
    iterations += strokes.step().iterations;
    benchmark::DoNotOptimize(simulation.deformed_surface());
  }
  state.counters["voxels"] = static_cast<double>(simulation.volume().voxels().size());
  state.counters["elements"] = static_cast<double>(simulation.model().mesh().elements().size());
  state.counters["links_severed"] = static_cast<double>(simulation.volume().severed_count());
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
  state.counters["steps/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void box(benchmark::State& state) {
  SimulationConfig config;
  config.tissue.voxel_size = Vec3::Constant(0.0025);
  config.tissue.fixed.resize(1);
  config.tissue.fixed[0].box = Box(Vec3(-1, -1, -1), Vec3(1, 1, 0.001));
  const auto shape = make_box(config.tissue.box_size, Pose::Identity());
  run(state, config, *shape, make_blade({Vec3::Zero(), Vec3(0.028, 0, 0)}, Vec3::UnitZ(), 0.0));
}
BENCHMARK(box)->Arg(1)->Arg(2)->Iterations(300)->Unit(benchmark::kMillisecond)->UseRealTime();

void liver(benchmark::State& state) {
  const std::string file = std::string(CFEM_CUTTING_SOURCE_DIR) + "/config/liver.yaml";
  const Config config = read_config_file(file, {});
  const PathResolver resolve = make_path_resolver(file);
  if (!std::filesystem::exists(resolve(config.simulation.tissue.source))) {
    state.SkipWithError("no liver: run scripts/fetch_data");
    return;
  }
  const auto shape = load_shape(config.simulation.tissue, resolve);
  run(state, config.simulation, *shape, load_blade(config.simulation.blade, resolve));
}
BENCHMARK(liver)->Arg(1)->Arg(2)->Iterations(300)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cfem_cutting

BENCHMARK_MAIN();
