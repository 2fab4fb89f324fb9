#pragma once

#include <cstdint>
#include <vector>

#include "level_system.h"

namespace cfem_cutting {

/// The largest eigenvalue of a level's M⁻¹ A at rest, kept from mesh to mesh. After a cut it is looked for
/// only at the nodes of elements that changed: it belongs to a few nodes mostly (of slivers, of corners), and
/// either they are among those, or it was known. An estimate: see LevelSystem's safety, and the solver's way
/// out when it is too low.
class LargestEigenvalue {
 public:
  /// @param level right after LevelSystem::arrange
  double update(LevelSystem& level);

 private:
  /// An element as its neighbours see it: its matrix's diagonal, and of its nodes how many elements meet
  /// there and whether they are held. Equal ones mean that nothing changed.
  struct Print {
    std::uint64_t place;  // Morton's
    std::uint64_t look;
    int element;
  };
  static std::vector<Print> prints_of(const LevelSystem& level);
  static bool before(const Print& a, const Print& b);
  static double largest_near(const std::vector<Print>& changed, const LevelSystem& level);

  std::vector<Print> known_;
  double largest_ = 0.0;
};

}  // namespace cfem_cutting
