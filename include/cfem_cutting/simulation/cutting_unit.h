#pragma once

#include <algorithm>
#include <vector>

#include "cfem_cutting/cutting/fracture.h"

namespace cfem_cutting {

/// The deformation–fracture unit in progress: the links that the front has met and that wait to be severed.
class CuttingUnit {
 public:
  std::uint32_t number = 1;
  double blade_work = 0.0;      ///< J, in this unit
  double peak_force = 0.0;      ///< N, in this unit
  double largest_offset = 0.0;  ///< m, of the contact points, now

  const std::vector<Candidate>& candidates() const { return candidates_; }

  /// Adds the links that a sweep meets; a link that waits already is met once.
  void collect(const std::vector<Crossing>& crossings);

  /// Updates the candidates' offsets and their distances from the front (of those left behind no more); drops
  /// those that the front has retreated from by more than two blocks.
  /// @param front its runs in and beside tissue, m, material
  /// @param push the way the blade cuts, in material space
  void measure(const VoxelVolume& volume, const OffsetField& offsets, const std::vector<Polyline>& front,
               const Vec3& push, double block);

  /// The contact ended: nothing waits any more.
  void drop() { candidates_.clear(); }

  /// Drops the links for which `goes` is true.
  template <typename Predicate>
  void drop_if(Predicate goes) {
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), goes), candidates_.end());
  }

  /// The front has passed all links that wait for good.
  void leave_behind();

  /// The next unit begins; these candidates wait on.
  void begin_next(const std::vector<Candidate>& waiting);

 private:
  std::vector<Candidate> candidates_;  // sorted by link
};

}  // namespace cfem_cutting
