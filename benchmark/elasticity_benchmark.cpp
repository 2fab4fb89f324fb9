// Times of the elastic solver on cubes of tissue: products, V-cycles, whole steps, cuts, start-up. Counters:
// time per element in yardsticks (see yardstick.h), elements per second.

#include <benchmark/benchmark.h>

#include "cfem_cutting/elasticity/inverse_map.h"
#include "cfem_cutting/volume/shapes.h"
#include "elasticity/cubes.h"
#include "linear_system.h"
#include "yardstick.h"

namespace cfem_cutting {
namespace {

const std::vector<std::int64_t> kSides{10, 16, 20, 32, 50};  // 1k, 4k, 8k, 32k and 125k elements
const Material kTissue{-1, 1e4, 0.45, 1060.0};

/// A cube of 0.1 m with `across` elements an edge; tilted: its surface elements are partly filled.
VoxelVolume cube(int across, bool tilted) {
  Pose pose = Pose::Identity();
  if (tilted) pose.linear() = Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return VoxelVolume::sample(*make_box(Vec3::Constant(0.1), pose), Vec3::Constant(0.1 / across));
}

ElasticModel model_of(const VoxelVolume& volume, const Material& material = kTissue) {
  return {volume, 0, {material}, ElementKind::kIncompatibleModes, Kinematics::kCorotational};
}

void report(benchmark::State& state, std::size_t elements, double per_iteration = 1.0) {
  using benchmark::Counter;
  const double count = static_cast<double>(elements);
  state.counters["elements"] = count;
  state.counters["elements/s"] = Counter(count * per_iteration, Counter::kIsIterationInvariantRate);
  state.counters["yardsticks"] =
      Counter(count * yardstick(), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void product(benchmark::State& state) {
  const ElasticModel model = model_of(cube(static_cast<int>(state.range(0)), state.range(1)));
  ThreadPool pool(1);
  ElementProduct product(pool);
  product.arrange(model.elements());
  const SingleField x = to_quads(model.mesh().rest());
  SingleField y;
  for (auto _ : state) product.apply(x, y);
  report(state, model.mesh().elements().size());
}
BENCHMARK(product)->ArgsProduct({kSides, {0}})->Args({32, 1})->Unit(benchmark::kMillisecond);

void v_cycle(benchmark::State& state) {
  const ElasticModel model = model_of(cube(static_cast<int>(state.range(0)), false));
  ThreadPool pool(static_cast<int>(state.range(1)));
  Multigrid multigrid(pool);
  const HeldNodes held = hold_bottom(model.mesh());
  const std::vector<PointConstraint> none;
  multigrid.arrange(model, held.nodes);
  multigrid.set(model.rotations(model.mesh().rest()),
                {Eigen::VectorXd::Zero(model.mesh().node_count()), 1.0, &none});
  const SingleField r = to_quads(NodeField::Random(3, model.mesh().node_count()));
  SingleField z;
  for (auto _ : state) multigrid.precondition(r, z);
  report(state, model.mesh().elements().size());
}
BENCHMARK(v_cycle)->ArgsProduct({kSides, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

void response(benchmark::State& state) {
  const ElasticModel model = model_of(cube(static_cast<int>(state.range(0)), state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(model.respond(model.mesh().rest()));
  report(state, model.mesh().elements().size());
}
BENCHMARK(response)->Args({32, 0})->Args({32, 1})->Unit(benchmark::kMillisecond);

constexpr int kSteps = 10;

/// Falls under its weight from rest, kSteps steps of 10 ms. Arguments: elements across, tilted, threads.
void step(benchmark::State& state) {
  const ElasticModel model = model_of(cube(static_cast<int>(state.range(0)), state.range(1)));
  const HeldNodes held = hold_bottom(model.mesh());
  SolverOptions options;
  options.threads = static_cast<int>(state.range(2));
  Integrator integrator(options);
  const ElasticState rest{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  ElasticState now = rest;
  integrator.step(model, now, 0.01, {0, 0, -9.81}, held, {});  // sets the solver up
  int iterations = 0;
  for (auto _ : state) {
    now = rest;
    for (int i = 0; i < kSteps; ++i) {
      const SolveReport solved = integrator.step(model, now, 0.01, {0, 0, -9.81}, held, {});
      iterations += solved.iterations;
      if (!solved.converged) state.SkipWithError("a step did not converge");
    }
  }
  state.counters["iterations"] = static_cast<double>(iterations) / kSteps / state.iterations();
  report(state, model.mesh().elements().size() * kSteps);
}
BENCHMARK(step)
    ->ArgsProduct({kSides, {0}, {1, 2}})
    ->Args({20, 1, 1})
    ->Args({32, 1, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// What the weight does to a cube at rest. Arguments: elements across, per cent of the height that is
/// cut, ν in per cent, tissue.
void tangent_solve(benchmark::State& state) {
  const auto tissue = static_cast<CubeTissue>(state.range(3));
  const ElasticModel model =
      cube_model(static_cast<int>(state.range(0)), tissue, 0.01 * static_cast<double>(state.range(1)),
                 0.01 * static_cast<double>(state.range(2)));
  count_iterations(model);  // the cache is warm then
  int iterations = 0;
  for (auto _ : state) iterations = count_iterations(model);
  state.counters["iterations"] = iterations;
  report(state, model.mesh().elements().size());
}
BENCHMARK(tangent_solve)
    ->ArgNames({"across", "cut", "nu", "tissue"})
    ->ArgsProduct({kSides, {0, 50}, {45}, {0}})
    ->Args({20, 0, 49, 0})
    ->ArgsProduct({{16, 32}, {0}, {45}, {1, 2}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// Severing a sheet of links halfway through, and all structures up to date, a solver's too.
void cut(benchmark::State& state) {
  const VoxelVolume whole = cube(static_cast<int>(state.range(0)), false);
  for (auto _ : state) {
    state.PauseTiming();
    VoxelVolume volume = whole;
    ElasticModel model = model_of(volume);
    ThreadPool pool(1);
    Multigrid multigrid(pool);
    multigrid.arrange(model, hold_bottom(model.mesh()).nodes);
    state.ResumeTiming();
    sever_half(volume, 0.5);
    model.update(volume);
    multigrid.arrange(model, hold_bottom(model.mesh()).nodes);
  }
  report(state, whole.voxels().size());
}
BENCHMARK(cut)->Arg(20)->Arg(32)->Iterations(3)->Unit(benchmark::kMillisecond);

void start_up(benchmark::State& state) {
  const VoxelVolume volume = cube(static_cast<int>(state.range(0)), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(model_of(volume).total_mass());
  report(state, volume.voxels().size());
}
BENCHMARK(start_up)->ArgsProduct({kSides, {0}})->Args({32, 1})->Iterations(2)->Unit(benchmark::kMillisecond);

void build_inverse_map(benchmark::State& state) {
  const VoxelVolume volume = cube(16, true);
  const CompositeMesh mesh(volume, 0);
  for (auto _ : state) InverseMap(volume, mesh, mesh.rest());
}
BENCHMARK(build_inverse_map)->Unit(benchmark::kMillisecond);

/// Points above the cube's surface (1) or inside (0).
void query_inverse_map(benchmark::State& state) {
  const VoxelVolume volume = cube(16, false);
  const CompositeMesh mesh(volume, 0);
  const InverseMap map(volume, mesh, mesh.rest());
  double x = 0.0;
  for (auto _ : state) {
    x = x > 0.09 ? 0.01 : x + 0.0013;
    benchmark::DoNotOptimize(map({x, 0.05, state.range(0) ? 0.105 : 0.04}));
  }
}
BENCHMARK(query_inverse_map)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cfem_cutting

BENCHMARK_MAIN();
