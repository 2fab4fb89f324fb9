#pragma once

#include <string>

#include "cfem_cutting/contact/edge_contact.h"
#include "cfem_cutting/cutting/cut_surface.h"
#include "cfem_cutting/cutting/swept_trail.h"
#include "cfem_cutting/simulation/cutting_unit.h"
#include "cfem_cutting/simulation/front_tracker.h"
#include "cfem_cutting/simulation/grips.h"
#include "cfem_cutting/simulation/simulation.h"
#include "dent.h"

namespace cfem_cutting {

/// The simulation's data and the stages of its loop, in the loop's order.
struct Simulation::State {
  State(const SimulationConfig& config_in, VoxelVolume uncut, const Blade& blade_in);

  void place_grips(const StepInput& input);
  void sweep(const StepInput& input);
  Fracture judge();
  void sever(const Fracture& fracture, StepReport& report);
  void adapt();
  void collide(double dt);
  void solve(StepReport& report);
  void account(StepReport& report);

  // Parts of the stages.
  void place_anew(const Pose& X_TB);
  void meet(const FrontMotion& motion);
  bool is_jump(const Pose& from, const Pose& to) const;
  bool is_in_earlier_cut(const Touch& touch, const Vec3& way = Vec3::Zero()) const;
  MaterialPoint pushed_in(const Touch& touch, const std::vector<Dent>& dents) const;
  std::vector<Dent> find_dents() const;
  double pushed_by_front(const EdgeContactPoint& p) const;
  void forget_dent(const EdgeContactPoint& p);
  void leave_tissue();
  void bind(const MaterialPoint& place, double along, bool at_cut_end);
  void release_left_points();
  void come_out();
  bool is_out() const { return contact.empty() && tracker.inside().empty(); }
  bool advances(const Fracture& fracture, const OffsetField& offsets) const;
  void let_go();
  void rebuild(const Fracture& fracture);
  void advance_cut_end();
  std::vector<SweptTriangle> take_opened(const Fracture& fracture);
  void describe(const Fracture& fracture, FractureEvent& event);
  void find_held();
  void refresh_reference();
  void carry_reference();
  void follow_free_state();
  OffsetField offset_field() const;
  double potential(const NodeField& x) const;
  static double offset(const OffsetField& offsets, const EdgeContactPoint& p);
  double contact_offset(const OffsetField& offsets) const;
  FrontTrace front_trace();
  bool holds(const EdgeContactPoint& p) const;
  Polyline follow_edge(const FrontEnd& end, const Vec3& dent) const;
  bool in_tissue_between(const EdgeContactPoint& a, const EdgeContactPoint& b) const;
  void extend(const EdgeContactPoint& last, double until, int step, Trace& trace) const;
  bool is_same_piece(int voxel, int other) const;
  bool leads_back(const EdgeContactPoint& from, const Vec3& X, int step) const;
  double along_edge(const Vec3& X, int voxel) const;
  std::vector<EdgePart> held_parts() const;
  double dent_radius() const { return 0.75 * contact_spacing(); }  ///< m, half the widest gap
  double contact_spacing() const { return 0.5 * volume.lattice().spacing.minCoeff(); }
  Vec3 push() const;
  void take_wrench();
  bool immediate() const { return config.fracture.mode == FractureMode::kImmediate; }

  SimulationConfig config;
  Blade blade;
  VoxelVolume rest_volume;  // uncut, for reset
  VoxelVolume volume;
  ElasticModel model;
  Integrator integrator;
  Pieces pieces;
  Grips grips;
  std::vector<char> floating;  // per node, whether no grip holds its piece
  ElasticState elastic;
  NodeField reference;                    // φ_ref: equilibrium without the blade
  std::unique_ptr<InverseMap> pull_back;  // of φ_ref
  double block;                           // m, longest edge of a composite element
  FrontTracker tracker;
  EdgeContact contact;
  std::vector<PointConstraint> constraints;
  CuttingUnit unit;
  SweptTrail trail;
  CutSurface cut_surface;
  SurfaceExtractor extractor;
  std::vector<std::pair<MaterialPoint, MaterialPoint>> held;  // neighbouring contact points on the trace
  Pose motion = Pose::Identity();                             // of the blade in this step, in T
  Wrench wrench;                                              // tissue on tool, in T, after the last solve
  double cut_area = 0.0;                                      // m²
  double blade_work = 0.0;                                    // J
  double elapsed = 0.0;                                       // s, since the start
  bool reference_converged = true;
  double grip_step = 0.0;    // m, in this step
  double grip_travel = 0.0;  // m, since the reference was solved for
  NodeField drift;           // of the reference, over the grips' way, when it was last carried
  double last_travel = 0.0;  // m, of the grips, then
  std::vector<std::string> warnings;
};

}  // namespace cfem_cutting
