#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/simulation/config.h"
#include "cfem_cutting/simulation/reports.h"
#include "cfem_cutting/surface/front_fidelity.h"

namespace cfem_cutting {

/// What happens in one step.
struct StepInput {
  double time = 0.0;  ///< s, at the end of the step
  std::vector<Pose>
      path;  ///< X_TB, poses of the tool passed through since the last step, in order; empty: no tool
  bool front_anew =
      false;  ///< the way to the first pose of `path` is unknown (gap, time jump) and cuts nothing
  std::map<std::string, Pose> grips;  ///< X_TF of followed frames, by name; a missing one stays where it was
};

/// Of cut faces from what the blade has swept (cut or dented only), undeformed, m; what is farther than a
/// voxel counts as a voxel.
struct CutFaceDistances {
  Distances faces;         ///< at their triangles' centres, and at corners that the blade does not hold
  Distances held_corners;  ///< at those that it holds now, which lie on its trace
};

/// Cutting simulation of one tissue with one blade (Jia et al., Pacific Graphics 2019, Algorithm 1),
/// ROS-free.
class Simulation {
 public:
  /// @param shape the tissue
  /// @throw ConfigError, GeometryError
  Simulation(const SimulationConfig& config, const Shape& shape, const Blade& blade);
  ~Simulation();

  /// Steps by the configured time step.
  StepReport step(const StepInput& input);

  /// Back to the uncut rest shape.
  void reset();

  /// Whether the blade goes farther than blade.max_travel between two poses: nothing is cut on that way.
  bool is_jump(const Pose& from, const Pose& to) const;

  const SimulationConfig& config() const;
  const VoxelVolume& volume() const;
  const ElasticModel& model() const;
  const Pieces& pieces() const;
  const ElasticState& state() const;
  const TissueSurface& surface() const;
  const Front& front() const;  ///< in T, now; empty before the first pose

  /// The surface as drawn now.
  DeformedSurface deformed_surface() const;
  /// How close crease and cut end are to the edge now; nothing where the blade touches no tissue.
  FrontFidelity front_fidelity() const;
  CutFaceDistances cut_face_distances() const;
  /// Per vertex of a surface drawn now: displacement since the unit's reference state, m.
  std::vector<double> offsets(const DeformedSurface& surface) const;
  /// Displacements of the configured probes, m.
  std::vector<Vec3> probe_displacements() const;
  /// Things a user should know about the input (tissue left out, probes outside, …), a line each.
  const std::vector<std::string>& warnings() const;

 private:
  struct State;
  std::unique_ptr<State> s_;
};

}  // namespace cfem_cutting
