#pragma once
/// Everything that a user can set, in SI units; defaults, ranges and documentation of each key stand in
/// src/io/schema (read by the node from parameters and by `replay` from a file).

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cfem_cutting/cutting/fracture.h"
#include "cfem_cutting/elasticity/elastic_model.h"
#include "cfem_cutting/elasticity/integrator.h"

namespace cfem_cutting {

/// A held region: nodes whose rest position lies in the box (m, tissue frame).
struct GripConfig {
  Box box;
  Vec3 displacement = Vec3::Zero();  ///< m, moved there linearly within `ramp`
  double ramp = 1.0;                 ///< s
  std::string follow;                ///< a tf frame that carries the region; empty: none
};

struct TissueConfig {
  std::string frame = "tissue";
  std::string source = "box";     ///< a file (package://, file://, plain path) or "box"
  Vec3 box_size{0.1, 0.1, 0.05};  ///< m
  double scale = 1.0;             ///< m per mesh unit
  Vec3 xyz = Vec3::Zero();        ///< m
  Vec3 rpy = Vec3::Zero();        ///< rad, fixed axes x, y, z as in URDF
  std::vector<int> labels{255};
  Vec3 voxel_size = Vec3::Constant(0.004);  ///< m
  int composite_level = 1;
  Vec3 gravity = Vec3::Zero();  ///< m/s²
  std::vector<Material> materials{Material{}};
  std::vector<GripConfig> fixed;
};

struct BladeConfig {
  Polyline edge;  ///< m, tool frame; empty if edge_links are used
  std::vector<std::string> edge_links;
  std::string urdf;  ///< file; empty: parameter robot_description
  Vec3 back{0, 0, 1};
  double friction = 0.0;
  std::string tool_link = "scalpel";
  double max_travel = 0.02;  ///< m
};

/// How the tissue of a label is drawn.
struct LabelColour {
  int label = 0;               ///< boxes and meshes have 0
  Vec3 colour = Vec3::Zero();  ///< red, green, blue, 0 to 1
};

/// How the markers' triangles are shaded: each by its own normal, as rviz lights it, or smoothly by the
/// surface's normals, in vertex colours.
enum class Shading { kFlat, kSmooth };

struct SurfaceConfig {
  bool influence_domain_adaptation = true;
  Shading shading = Shading::kFlat;
  std::vector<int> hidden_labels;          ///< whose skin and cut faces are not drawn
  std::vector<LabelColour> label_colours;  ///< instead of the colours of skin and cut faces
};

struct DynamicsConfig {
  ElementKind element = ElementKind::kIncompatibleModes;
  Kinematics kinematics = Kinematics::kCorotational;
  bool quasi_static = false;  ///< integration: quasi_static instead of implicit_euler
  double time_step = 0.01;    ///< s
  SolverOptions solver;
};

/// What the simulation itself needs. Node settings stand in io/config_reader.h.
struct SimulationConfig {
  TissueConfig tissue;
  BladeConfig blade;
  FractureOptions fracture;
  SurfaceConfig surface;
  DynamicsConfig dynamics;
  std::vector<Vec3> probes;  ///< m, material points
};

}  // namespace cfem_cutting
