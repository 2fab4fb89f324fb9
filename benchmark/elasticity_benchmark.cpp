/// Times of the elastic solver on boxes and tilted boxes of tissue, one thread.

#include <benchmark/benchmark.h>

#include "cfem_cutting/elasticity/integrator.h"
#include "cfem_cutting/elasticity/inverse_map.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

/// A cube of 0.1 m with `across` elements an edge; tilted: its surface elements are partly filled.
VoxelVolume cube(int across, bool tilted) {
  Pose pose = Pose::Identity();
  if (tilted) pose.linear() = Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return VoxelVolume::sample(*make_box(Vec3::Constant(0.1), pose), Vec3::Constant(0.1 / across));
}

ElasticModel model_of(const VoxelVolume& volume, int level = 0) {
  return {volume, level, {Material()}, ElementKind::kIncompatibleModes, Kinematics::kCorotational};
}

HeldNodes hold_bottom(const CompositeMesh& mesh) {
  HeldNodes held;
  const double bottom = mesh.rest().row(2).minCoeff() + 0.01;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (mesh.rest()(2, n) > bottom) continue;
    held.nodes.push_back(n);
    held.positions.push_back(mesh.rest().col(n));
  }
  return held;
}

void BM_Build(benchmark::State& state) {
  const VoxelVolume volume = cube(static_cast<int>(state.range(0)), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(model_of(volume).total_mass());
  state.counters["voxels"] = static_cast<double>(volume.voxels().size());
}
BENCHMARK(BM_Build)->Args({16, 0})->Args({16, 1})->Args({30, 1})->Unit(benchmark::kMillisecond);

void BM_Forces(benchmark::State& state) {
  const VoxelVolume volume = cube(16, state.range(0));
  const ElasticModel model = model_of(volume);
  for (auto _ : state) benchmark::DoNotOptimize(model.forces(model.mesh().rest()));
}
BENCHMARK(BM_Forces)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BM_Step(benchmark::State& state) {
  const VoxelVolume volume = cube(static_cast<int>(state.range(0)), state.range(1));
  const ElasticModel model = model_of(volume);
  const HeldNodes held = hold_bottom(model.mesh());
  SolverOptions options;
  options.threads = 1;
  Integrator integrator(options);
  ElasticState now{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  int iterations = 0;
  for (auto _ : state) iterations += integrator.step(model, now, 0.01, {0, 0, -9.81}, held, {}).iterations;
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["elements"] = static_cast<double>(model.mesh().elements().size());
}
BENCHMARK(BM_Step)->Args({16, 0})->Args({16, 1})->Args({32, 0})->Unit(benchmark::kMillisecond);

void BM_BuildInverseMap(benchmark::State& state) {
  const VoxelVolume volume = cube(16, true);
  const CompositeMesh mesh(volume, 0);
  for (auto _ : state) InverseMap(volume, mesh, mesh.rest());
}
BENCHMARK(BM_BuildInverseMap)->Unit(benchmark::kMillisecond);

/// Points above the cube's surface (1) or inside (0).
void BM_QueryInverseMap(benchmark::State& state) {
  const VoxelVolume volume = cube(16, false);
  const CompositeMesh mesh(volume, 0);
  const InverseMap map(volume, mesh, mesh.rest());
  double x = 0.0;
  for (auto _ : state) {
    x = x > 0.09 ? 0.01 : x + 0.0013;
    benchmark::DoNotOptimize(map({x, 0.05, state.range(0) ? 0.105 : 0.04}));
  }
}
BENCHMARK(BM_QueryInverseMap)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cfem_cutting

BENCHMARK_MAIN();
