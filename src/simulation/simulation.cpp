#include "cfem_cutting/simulation/simulation.h"

#include <algorithm>

#include "simulation_state.h"
#include "stopwatch.h"

namespace cfem_cutting {

Simulation::Simulation(const SimulationConfig& config, const Shape& shape, const Blade& blade)
    : s_(std::make_unique<State>(config, VoxelVolume::sample(shape, config.tissue.voxel_size), blade)) {}

Simulation::~Simulation() = default;

// Algorithm 1 of the paper.
StepReport Simulation::step(const StepInput& input) {
  StepReport report;
  report.time = input.time;
  Stopwatch watch(report.stages);
  s_->place_grips(input);
  s_->sweep(input);
  watch.lap("sweep");
  const Fracture fracture = s_->judge();
  watch.lap("judge");
  if (fracture.happens) s_->sever(fracture, report);
  watch.lap("sever");
  s_->adapt();
  watch.lap("adapt");
  s_->collide(s_->config.dynamics.time_step);
  watch.lap("collide");
  s_->solve(report);
  watch.lap("solve");
  s_->account(report);
  watch.lap("report");
  return report;
}

void Simulation::reset() {
  s_ = std::make_unique<State>(s_->config, VoxelVolume(s_->rest_volume), s_->blade);
}

bool Simulation::is_jump(const Pose& from, const Pose& to) const { return s_->is_jump(from, to); }

const SimulationConfig& Simulation::config() const { return s_->config; }
const VoxelVolume& Simulation::volume() const { return s_->volume; }
const ElasticModel& Simulation::model() const { return s_->model; }
const Pieces& Simulation::pieces() const { return s_->pieces; }
const ElasticState& Simulation::state() const { return s_->elastic; }
const TissueSurface& Simulation::surface() const { return s_->extractor.surface(); }
const Front& Simulation::front() const { return s_->tracker.front(); }
const std::vector<std::string>& Simulation::warnings() const { return s_->warnings; }

DeformedSurface Simulation::deformed_surface() const {
  const bool on_blade = s_->config.surface.influence_domain_adaptation;
  return deform(surface(), s_->model.mesh(), s_->elastic.x, on_blade ? front().points : Polyline());
}

FrontFidelity Simulation::front_fidelity() const {
  if (s_->held.empty() && s_->tracker.inside().empty()) return {};
  return measure_front(surface(), deformed_surface(), front().points, s_->held_parts(),
                       s_->volume.lattice().spacing.minCoeff());
}

CutFaceDistances Simulation::cut_face_distances() const {
  const double voxel = s_->volume.lattice().spacing.maxCoeff();
  CutSurface uncut(voxel);  // swept since the last fracture
  uncut.add(s_->volume, SweptTrail(s_->trail).take());
  const auto distance = [&](const Vec3& X) {
    return std::min({voxel, s_->cut_surface.distance(X, voxel), uncut.distance(X, voxel)});
  };
  CutFaceDistances distances;
  for (std::size_t t = 0; t < surface().triangles.size(); ++t) {
    if (!surface().cut[t]) continue;
    Vec3 centre = Vec3::Zero();
    for (const int v : surface().triangles[t]) {
      const SurfaceVertex& vertex = surface().vertices[v];
      centre += vertex.X / 3.0;
      const bool held = vertex.on_front && s_->config.surface.influence_domain_adaptation;
      (held ? distances.held_corners : distances.faces).add(distance(vertex.X));
    }
    distances.faces.add(distance(centre));
  }
  return distances;
}

std::vector<double> Simulation::offsets(const DeformedSurface& drawn) const {
  const OffsetField field = s_->offset_field();
  std::vector<double> values;
  values.reserve(drawn.positions.size());
  for (std::size_t i = 0; i < drawn.positions.size(); ++i) {
    const SurfaceVertex& vertex = surface().vertices[drawn.source[i]];
    values.push_back(field.offset(vertex.voxel, vertex.X));
  }
  return values;
}

std::vector<Vec3> Simulation::probe_displacements() const {
  std::vector<Vec3> displacements;
  for (const Vec3& X : s_->config.probes) {
    const int voxel = tissue_voxel_at(s_->volume, X);
    displacements.push_back(voxel < 0 ? Vec3::Zero()
                                      : Vec3(s_->model.mesh().embed(voxel, X).apply(s_->elastic.x) - X));
  }
  return displacements;
}

}  // namespace cfem_cutting
