#pragma once

#include <array>
#include <string>
#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

enum class Phase : std::uint8_t { kFree = 0, kDeforming = 1, kFractured = 2 };

/// Force and moment of the tissue on the tool.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N·m, about the origin of the frame it is expressed in
};

/// A contact's force on the tool.
struct ContactForce {
  Vec3 point;  ///< m, in T
  Vec3 force;  ///< N, in T
};

/// The fracture that ends a deformation–fracture unit; in the tissue frame T.
struct FractureEvent {
  double time = 0.0;       ///< s
  std::uint32_t unit = 0;  ///< from 1
  std::uint32_t links_severed = 0;
  double area = 0.0;                  ///< m², new cut area
  double largest_offset = 0.0;        ///< m
  double fracture_work = 0.0;         ///< J, elastic energy that the fracture set free
  double blade_work = 0.0;            ///< J, done by the blade in this unit
  double peak_force = 0.0;            ///< N, in this unit
  Vec3 centroid = Vec3::Zero();       ///< m, of the new cut
  Vec3 normal = Vec3::UnitZ();        ///< unit, of the new cut
  Polyline front;                     ///< m, blade front at fracture
  std::vector<double> piece_volumes;  ///< m³, after, largest first
  bool separated = false;             ///< a piece came off
};

struct StageTime {
  std::string stage;
  double milliseconds;
};

/// What one step did.
struct StepReport {
  double time = 0.0;  ///< s, at the end of the step
  Phase phase = Phase::kFree;
  std::uint32_t unit = 1;
  double largest_offset = 0.0;  ///< m
  std::uint32_t candidates = 0;
  std::uint32_t links_severed = 0;  ///< so far
  double cut_area = 0.0;            ///< m², so far
  std::uint32_t pieces = 1;
  int iterations = 0;
  double residual = 0.0;
  bool converged = true;
  int inverted_elements = 0;
  double blade_work = 0.0;  ///< J, done by the blade so far
  Wrench spatial;           ///< tissue on tool, in T, moment about T's origin
  Wrench body;              ///< tissue on tool, in the tool frame B, moment about B's origin
  std::vector<ContactForce> contacts;
  std::vector<FractureEvent> events;  ///< in this step
  std::vector<StageTime> stages;
};

}  // namespace cfem_cutting
