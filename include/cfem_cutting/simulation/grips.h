#pragma once

#include <map>
#include <string>
#include <vector>

#include "cfem_cutting/elasticity/integrator.h"
#include "cfem_cutting/simulation/config.h"

namespace cfem_cutting {

/// Held regions over time: fixed, displaced within a ramp, or carried by a frame.
class Grips {
 public:
  explicit Grips(std::vector<GripConfig> grips) : grips_(std::move(grips)) {}

  /// Finds the nodes in the regions by their rest positions; a node in several belongs to the first.
  void find_nodes(const CompositeMesh& mesh);

  /// Positions at a time since the start, s. Frames that are missing stay where they were; a frame's first
  /// pose is where it takes hold.
  /// @return how far the farthest node moved, m
  double move(const CompositeMesh& mesh, double time, const std::map<std::string, Pose>& frames);

  const HeldNodes& held() const { return held_; }

  /// Regions that hold no node, by number.
  std::vector<int> idle() const;

 private:
  struct Carrier {
    Pose first;
    Pose now;
  };
  Vec3 position(int grip, const Vec3& X, double time) const;

  std::vector<GripConfig> grips_;
  std::map<std::string, Carrier> carriers_;  // frames seen so far
  HeldNodes held_;
  std::vector<int> grip_of_held_;
};

}  // namespace cfem_cutting
