#pragma once

#include <string>
#include <vector>

#include "surface_check.h"

namespace cfem_cutting::random_cuts {

enum class Kind { kThrough, kStopped, kCrossing };

struct Options {
  Kind kind = Kind::kThrough;
  std::string bunny;            ///< mesh file
  bool self_crossings = false;  ///< look for them too (slow)
};

/// What a random cut did, and where it differs from the oracles.
struct Outcome {
  std::string description;
  std::vector<std::string> failures;
  std::int64_t links_severed = 0;
  int pieces = 0;
  double volume_error = 0.0;  ///< of the surface against the filled voxels, relative
  SurfaceFigures surface;
};

/// Makes the cut of this seed and checks it.
Outcome try_cut(std::uint64_t seed, const Options& options);

}  // namespace cfem_cutting::random_cuts
