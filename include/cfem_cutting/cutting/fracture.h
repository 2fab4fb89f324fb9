#pragma once

#include <limits>
#include <vector>

#include "cfem_cutting/cutting/crossings.h"

namespace cfem_cutting {

enum class FractureMode { kDelayed, kImmediate };

struct FractureOptions {
  FractureMode mode = FractureMode::kDelayed;
  double onset_offset = 0.003;    ///< d0, m
  double release_offset = 0.001;  ///< d1 < d0, m
};

/// A link that waits in the current unit.
struct Candidate {
  Crossing crossing;
  double offset = 0.0;     ///< m, the larger of its two ends'
  double passed_by = 0.0;  ///< m, how far the front has gone beyond the crossing
  double front_distance = std::numeric_limits<double>::infinity();  ///< m, from the crossing to the front
};

/// Links to be severed and those that wait on.
struct Fracture {
  bool happens = false;
  bool advances = false;  ///< the cut's end goes to the front; false if it happens to links left behind alone
  std::vector<Crossing> severed;
  std::vector<Candidate> waiting;
};

/// Decides by the offset criterion (the paper's delayed fracture): it happens when the largest offset of
/// candidates and contacts exceeds d0; then candidates with an offset above d1 are severed. A candidate that
/// the front has passed by more than max(d0, 2h) is severed in any case (and makes it happen; below d0 it
/// takes no others along and the load on the cut's end goes on). In immediate mode any candidate makes it
/// happen and all are severed. h is `block`.
/// @param contact_offset m, the largest offset of contact points
/// @param block m, the edge of a composite element
Fracture decide(const FractureOptions& options, const std::vector<Candidate>& candidates,
                double contact_offset, double block);

/// Displacement since the reference state; of a piece that nothing holds, minus its best-fit rigid motion.
/// (Of a held piece the whole displacement counts, as in the paper: the best fit would take a part of any
/// bend for a rigid motion.)
class OffsetField {
 public:
  /// @param floating per node, whether nothing holds its piece
  /// @param reference, current node positions, (3 × |nodes|)
  OffsetField(const VoxelVolume& volume, const Pieces& pieces, const CompositeMesh& mesh,
              const std::vector<char>& floating, const NodeField& reference, const NodeField& current);

  /// m, of a material point that moves with a voxel's element.
  double offset(int voxel, const Vec3& X) const;

  /// m, of a material point if it stood at x (m, in T).
  double offset_at(int voxel, const Vec3& X, const Vec3& x) const;

 private:
  const Pieces& pieces_;
  const CompositeMesh& mesh_;
  const NodeField& reference_;
  const NodeField& current_;
  std::vector<Pose> rigid_motion_;  // of each piece, reference → current; identity if it is held
};

}  // namespace cfem_cutting
