#pragma once

#include "cfem_cutting/blade/blade.h"
#include "dice.h"
#include "tissue.h"

namespace cfem_cutting::random_cuts {

/// A blade and the poses it takes one after another.
struct Stroke {
  Blade blade;
  std::vector<Pose> poses;  ///< X_TB, two or more
};

/// How a stroke lies in the lattice.
enum class Aim {
  kAnywhere,
  kOnLattice,     ///< in a plane of voxel faces or centres, or through points half a voxel apart
  kNearlyLattice  ///< within 1e-12 voxels of that
};

/// A stroke through all the tissue: its sheet, a plane or curved, at any angle, extends past the tissue on
/// all sides. 1 to 200 ways from pose to pose, straight or jittered.
Stroke random_stroke(Dice& dice, const Tissue& tissue, Aim aim);

/// Stops a stroke on its way, and may shorten the blade so that its tip passes inside the tissue.
void stop(Stroke& stroke, Dice& dice);

}  // namespace cfem_cutting::random_cuts
