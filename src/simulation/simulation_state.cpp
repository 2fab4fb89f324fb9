#include "simulation_state.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "cfem_cutting/elasticity/floating.h"

namespace cfem_cutting {
namespace {

/// Penalty of a contact point over Young's modulus times block edge: a point stays within about 5 % of a
/// voxel of the blade in the first step, and the multipliers take the rest.
constexpr double kContactStiffness = 20.0;

double stiffest(const std::vector<Material>& materials) {
  double modulus = 0.0;
  for (const Material& m : materials) modulus = std::max(modulus, m.young_modulus);
  return modulus;
}

double half_voxel(const VoxelVolume& volume) { return 0.5 * volume.lattice().spacing.minCoeff(); }

/// What is said of labels that the tissue does not have.
template <typename Warn>
void look_for_labels(const VoxelVolume& volume, const SimulationConfig& config, const Warn& warn) {
  std::set<int> labels;
  for (const Voxel& voxel : volume.voxels()) labels.insert(voxel.label);
  std::set<int> used;
  for (const int label : labels) used.insert(match_material(config.tissue.materials, label));
  for (int m = 0; m < static_cast<int>(config.tissue.materials.size()); ++m)
    if (used.count(m) == 0)
      warn("tissue.materials[", m, "]: no tissue is of it: must be the first that matches a label");
  for (const int label : config.surface.hidden_labels)
    if (labels.count(label) == 0) warn("surface.hidden_labels: no tissue has label ", label);
  for (const LabelColour& colour : config.surface.label_colours)
    if (labels.count(colour.label) == 0) warn("surface.label_colours: no tissue has label ", colour.label);
}

std::vector<std::string> find_warnings(const VoxelVolume& volume, const Grips& grips,
                                       const SimulationConfig& config) {
  std::vector<std::string> warnings;
  const auto warn = [&](auto&&... parts) {
    std::ostringstream line;
    (line << ... << parts);
    warnings.push_back(line.str());
  };
  if (volume.dropped_volume() > 0.0)
    warn("tissue.voxel_size: ", volume.dropped_volume(), " m^3 of tissue thinner than a voxel was left out");
  if (grips.held().nodes.empty()) warn("tissue.fixed: no node is held, the tissue floats");
  for (int grip : grips.idle()) warn("tissue.fixed[", grip, "]: holds no node: must reach into the tissue");
  for (const Vec3& X : config.probes)
    if (tissue_voxel_at(volume, X) < 0)
      warn("probes: [", X.x(), ", ", X.y(), ", ", X.z(), "] lies outside the tissue");
  look_for_labels(volume, config, warn);
  return warnings;
}

}  // namespace

Simulation::State::State(const SimulationConfig& config_in, VoxelVolume uncut, const Blade& blade_in)
    : config(config_in),
      blade(blade_in),
      rest_volume(std::move(uncut)),
      volume(rest_volume),
      model(volume, config.tissue.composite_level, config.tissue.materials, config.dynamics.element,
            config.dynamics.kinematics),
      integrator(config.dynamics.solver),
      pieces(find_pieces(volume)),
      grips(config.tissue.fixed),
      elastic{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())},
      reference(elastic.x),
      pull_back(std::make_unique<InverseMap>(volume, model.mesh(), reference)),
      block(model.mesh().block_size().maxCoeff()),
      tracker(blade, half_voxel(volume)),
      contact(half_voxel(volume), kContactStiffness * stiffest(config.tissue.materials) * block,
              blade.friction),
      trail(0.125 * volume.lattice().spacing.minCoeff()),
      cut_surface(volume.lattice().spacing.maxCoeff()),
      extractor(volume, [this](const Vec3& X) {
        return cut_surface.nearest(X, volume.lattice().spacing.maxCoeff());
      }) {
  find_held();
  extractor.extract({});
  warnings = find_warnings(volume, grips, config);
}

void Simulation::State::place_grips(const StepInput& input) {
  elapsed += config.dynamics.time_step;
  constexpr double kNoticeable = 0.02;  // of a voxel
  grip_step = grips.move(model.mesh(), elapsed, input.grips);
  grip_travel += grip_step;
  const bool outdated = grip_travel > kNoticeable * volume.lattice().spacing.minCoeff();
  if (outdated && !contact.empty()) carry_reference();
}

/// Grips mostly move on as they did: so the reference is looked for where it would be then, but no farther on
/// than it went the last time.
void Simulation::State::carry_reference() {
  const double travel = grip_travel;
  const NodeField before = reference;
  if (drift.cols() == reference.cols()) reference += std::min(travel, last_travel) * drift;
  refresh_reference();
  drift = (reference - before) / travel;
  last_travel = travel;
}

void Simulation::State::find_held() {
  grips.find_nodes(model.mesh());
  floating = floating_nodes(model.mesh(), grips.held().nodes);
}

/// In contact the reference is solved for: at first touch, after each fracture that severs links, and when
/// grips have moved noticeably.
void Simulation::State::refresh_reference() {
  grip_travel = 0.0;
  reference_converged =
      integrator.equilibrate(model, reference, config.tissue.gravity, grips.held(), {}).converged;
  pull_back = std::make_unique<InverseMap>(volume, model.mesh(), reference);
}

/// Without the blade the tissue is its own reference, unless it still swings (faster than grips carry it): a
/// blade in its cut would seem to go to and fro.
void Simulation::State::follow_free_state() {
  constexpr double kNegligible = 1.0e-4;  // of a block
  constexpr double kSwing = 0.05;         // of a block in a step
  double swing = 0.0;
  for (Eigen::Index n = 0; n < reference.cols(); ++n)
    if (!floating[n]) swing = std::max(swing, elastic.v.col(n).norm() * config.dynamics.time_step);
  NodeField next = elastic.x;
  for (Eigen::Index n = 0; n < reference.cols(); ++n)
    if (!floating[n] && swing > kSwing * block + grip_step) next.col(n) = reference.col(n);
  if ((next - reference).cwiseAbs().maxCoeff() < kNegligible * block) return;
  reference = std::move(next);
  reference_converged = true;
  pull_back = std::make_unique<InverseMap>(volume, model.mesh(), reference);
}

OffsetField Simulation::State::offset_field() const {
  return OffsetField(volume, pieces, model.mesh(), floating, reference, elastic.x);
}

double Simulation::State::potential(const NodeField& x) const {
  return model.energy(x) - config.tissue.gravity.dot(x * model.mass());
}

Vec3 Simulation::State::push() const { return -tracker.front().back; }

void Simulation::State::adapt() {
  extractor.extract(front_trace(), config.surface.influence_domain_adaptation);
}

void Simulation::State::collide(double dt) {
  contact.follow(tracker.front(), motion, model.mesh(), elastic.x);
  constraints = contact.constraints(model.mesh(), elastic.x, dt);
}

void Simulation::State::solve(StepReport& report) {
  const auto& gravity = config.tissue.gravity;
  SolveReport solved;
  if (config.dynamics.quasi_static) {
    solved = integrator.equilibrate(model, elastic.x, gravity, grips.held(), constraints);
    elastic.v.setZero();
  } else {
    solved = integrator.step(model, elastic, config.dynamics.time_step, gravity, grips.held(), constraints);
  }
  if (!elastic.x.allFinite()) throw std::runtime_error("the tissue's positions are not finite any more");
  contact.take_forces(constraints, elastic.x);
  if (contact.empty()) follow_free_state();
  report.iterations = solved.iterations;
  report.residual = solved.residual;
  report.converged = solved.converged && reference_converged;
  report.inverted_elements = solved.inverted_elements;
}

}  // namespace cfem_cutting
