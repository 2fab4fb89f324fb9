#pragma once

#include <string>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/simulation/simulation.h"

namespace cfem_cutting {

/// What there is to see after a step, in the tissue frame: a copy, so that it can be drawn while the next
/// step runs.
struct Scene {
  double time = 0.0;  ///< s
  DeformedSurface surface;
  std::vector<double> offsets;  ///< m, per vertex
  Front front;                  ///< empty before the first pose
  Wrench spatial;               ///< tissue on tool
  std::vector<ContactForce> contacts;
};

/// @param last report of the last step, or an empty one
Scene take_scene(const Simulation& simulation, const StepReport& last);

}  // namespace cfem_cutting
