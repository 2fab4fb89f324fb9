#pragma once

#include <array>
#include <vector>

#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting {

/// A link's state. `kSurface`: the other end holds no linked voxel.
enum class LinkState : std::uint8_t { kIntact, kSevered, kSurface };

/// The six neighbours of a voxel: 2·axis + (0: towards smaller, 1: towards larger coordinates).
constexpr int kDirections = 6;
constexpr int opposite(int direction) { return direction ^ 1; }
inline Vec3i step(int direction) { return Vec3i::Unit(direction / 2) * (direction % 2 ? 1 : -1); }

/// Filled part of a voxel by sample points. Bit n of `mask` = sample n = a + 4(b + 4c) lies in tissue, at
/// corner + h·((a, b, c) + ½)/4. (Finite cell idea: Parvizian, Düster and Rank 2007.)
struct Fill {
  std::uint64_t mask = 0;
  double fraction() const { return __builtin_popcountll(mask) / 64.0; }
  bool full() const { return mask == ~std::uint64_t{0}; }
};

/// One voxel that holds tissue.
struct Voxel {
  Vec3i index;    ///< in the lattice
  int label = 0;  ///< of its tissue (most frequent among the filled samples)
  Fill fill;
  int host = -1;  ///< ≥ 0: an unlinked voxel (its centre lies outside), which belongs to
                  ///< the component of this linked voxel; −1: linked
  std::array<int, kDirections> neighbour{};   ///< linked voxel across each face, −1 if none
  std::array<LinkState, kDirections> link{};  ///< meaningful for linked voxels
  bool linked() const { return host < 0; }
};

/// A link between two linked voxels, named by its lower voxel and its axis.
struct LinkId {
  int voxel;  ///< of smaller coordinate
  int axis;   ///< 0, 1, 2
  bool operator==(const LinkId& o) const { return voxel == o.voxel && axis == o.axis; }
  bool operator<(const LinkId& o) const { return voxel != o.voxel ? voxel < o.voxel : axis < o.axis; }
};

/// Tissue as voxels and links (Dick, Georgii and Westermann 2011), in material space. Voxels are sorted by
/// lattice index; the voxels themselves never change, links only from intact to severed.
class VoxelVolume {
 public:
  /// Samples a shape on a lattice of the given spacing (m) that covers it with an empty layer all around.
  /// Voxel faces lie at whole multiples of the spacing from the tissue frame's origin. A voxel is linked if
  /// its centre is in tissue; should all its samples miss that tissue, the eight about its centre count as
  /// filled. An unlinked voxel goes to its best-filled linked face neighbour, else edge or corner neighbour.
  /// @throw GeometryError no voxel centre in tissue; more than `max_voxels` lattice voxels.
  static VoxelVolume sample(const Shape& shape, const Vec3& spacing, std::int64_t max_voxels = 20'000'000);

  const Lattice& lattice() const { return lattice_; }
  const std::vector<Voxel>& voxels() const { return voxels_; }
  const Voxel& voxel(int v) const { return voxels_[v]; }
  Vec3 centre(int v) const { return lattice_.centre(voxels_[v].index); }

  /// Voxel at a lattice index, −1 if there is none (also outside the lattice).
  int find(const Vec3i& index) const;

  /// Number of links between linked voxels, intact or severed.
  std::int64_t link_count() const { return link_count_; }
  std::int64_t severed_count() const { return severed_count_; }

  /// The Hermite datum of a severed or surface link seen from voxel v in a direction: its point, on the
  /// link and at least 0.02 of it away from both ends; and the normal that points away from v (of a surface
  /// link: the shape's outward normal).
  const SurfacePoint& crossing(int v, int direction) const;

  /// Severs an intact link at a point (m, kept between the two centres) of a surface with this normal (any
  /// sign). No-op if it is severed already.
  /// @return whether the link was intact
  bool sever(LinkId link, const SurfacePoint& crossing);

  /// Severed links, sorted.
  std::vector<LinkId> severed_links() const;

  /// m³, of the filled part of a voxel.
  double filled_volume(int v) const { return voxels_[v].fill.fraction() * lattice_.spacing.prod(); }

  /// m³, tissue in voxels that no linked voxel could host, which the model leaves out.
  double dropped_volume() const { return dropped_volume_; }

 private:
  void number_voxels();
  void host_unlinked_voxels();
  void link_voxels(const Shape& shape);
  void link_across(int v, int direction, const Shape& shape);
  int find_host(const Vec3i& index) const;
  int best_filled_linked(const Vec3i& index, int max_steps) const;
  Vec3 point_on_link(int v, int direction, const Vec3& X) const;
  void set_crossing(int v, int direction, const SurfacePoint& crossing);

  Lattice lattice_;
  std::vector<Voxel> voxels_;
  std::vector<int> voxel_of_cell_;                              // lattice index → voxel, −1
  std::vector<std::array<int, kDirections>> crossing_of_link_;  // per voxel → crossings_, −1
  std::vector<SurfacePoint> crossings_;
  std::int64_t link_count_ = 0;
  std::int64_t severed_count_ = 0;
  double dropped_volume_ = 0.0;
};

/// Connected components of the linked voxels under intact links; unlinked voxels follow their host.
struct Pieces {
  std::vector<int> piece_of_voxel;  ///< (|voxels|), pieces numbered by falling volume
  std::vector<double> volumes;      ///< m³, falling
  int count() const { return static_cast<int>(volumes.size()); }
};
Pieces find_pieces(const VoxelVolume& volume);

}  // namespace cfem_cutting
