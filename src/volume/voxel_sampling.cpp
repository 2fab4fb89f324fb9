#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {
namespace {

constexpr int kSamplesPerEdge = 4;
constexpr int kHostNotYetKnown = std::numeric_limits<int>::max();

/// The eight samples around a voxel's centre.
constexpr std::uint64_t central_samples() {
  std::uint64_t mask = 0;
  for (int c : {1, 2})
    for (int b : {1, 2})
      for (int a : {1, 2}) mask |= std::uint64_t{1} << (a + 4 * (b + 4 * c));
  return mask;
}

void refuse_too_many(const Vec3& size, std::int64_t max_voxels) {
  const double count = size.prod();
  if (count <= static_cast<double>(max_voxels)) return;
  throw GeometryError(std::to_string(static_cast<std::int64_t>(std::min(count, 9e18))) +
                      " voxels: more than " + std::to_string(max_voxels) +
                      "; raise tissue.voxel_size, or check tissue.scale");
}

[[noreturn]] void refuse_too_large(const Vec3& spacing, const Vec3& extent) {
  const Eigen::IOFormat list(6, Eigen::DontAlignCols, ", ", ", ", "", "", "[", "] m");
  std::ostringstream message;
  message << "tissue.voxel_size: " << spacing.transpose().format(list)
          << ": no voxel's centre lies in the tissue, whose extent is " << extent.transpose().format(list)
          << ": must be less";
  throw GeometryError(message.str());
}

/// Faces at multiples of the spacing from the tissue frame's origin; an empty layer all around.
Lattice covering_lattice(const Box& bounds, const Vec3& spacing, std::int64_t max_voxels) {
  if (bounds.isEmpty() || !bounds.sizes().allFinite())
    throw GeometryError("tissue shape: its bounds are empty or not finite");
  if (!(spacing.minCoeff() > 0.0) || !spacing.allFinite())
    throw GeometryError("tissue.voxel_size: every edge must be longer than 0 m");
  const double rounding = 1e-9;
  const Vec3 lower = (bounds.min().cwiseQuotient(spacing).array() + rounding).floor() - 1.0;
  const Vec3 upper = (bounds.max().cwiseQuotient(spacing).array() - rounding).ceil() + 1.0;
  const Vec3 size = (upper - lower).cwiseMax(3.0);
  refuse_too_many(size, max_voxels);
  return {lower.cwiseProduct(spacing), spacing, size.cast<int>()};
}

/// Labels of all samples of one column of voxels.
class ColumnSampler {
 public:
  ColumnSampler(const Shape& shape, const Lattice& lattice) : shape_(shape), lattice_(lattice) {
    for (int k = 0; k < lattice.size.z(); ++k) {
      const Vec3 corner = lattice.corner({0, 0, k});
      centre_z_.push_back(lattice.centre({0, 0, k}).z());
      for (int c = 0; c < kSamplesPerEdge; ++c) sample_z_.push_back(corner.z() + offset(c, 2));
    }
  }

  void sample(int i, int j) {
    const Vec3 corner = lattice_.corner({i, j, 0});
    const Vec3 centre = lattice_.centre({i, j, 0});
    centre_labels_ = shape_.labels_along_z(centre.x(), centre.y(), centre_z_);
    for (int b = 0; b < kSamplesPerEdge; ++b)
      for (int a = 0; a < kSamplesPerEdge; ++a)
        sample_labels_[a + kSamplesPerEdge * b] =
            shape_.labels_along_z(corner.x() + offset(a, 0), corner.y() + offset(b, 1), sample_z_);
  }

  /// Appends the voxels of the sampled column that hold tissue.
  void append_voxels(int i, int j, std::vector<Voxel>& voxels) const {
    for (int k = 0; k < lattice_.size.z(); ++k) {
      Voxel voxel;
      voxel.index = {i, j, k};
      voxel.fill.mask = mask(k);
      const bool centre_inside = centre_labels_[k] >= 0;
      if (!centre_inside && voxel.fill.mask == 0) continue;
      voxel.label = voxel.fill.mask != 0 ? most_frequent_label(k) : centre_labels_[k];
      if (voxel.fill.mask == 0) voxel.fill.mask = central_samples();
      voxel.host = centre_inside ? -1 : kHostNotYetKnown;
      voxels.push_back(voxel);
    }
  }

 private:
  double offset(int sample, int axis) const {
    return lattice_.spacing[axis] * (sample + 0.5) / kSamplesPerEdge;
  }

  std::uint64_t mask(int k) const {
    std::uint64_t mask = 0;
    for (int c = 0; c < kSamplesPerEdge; ++c)
      for (int ab = 0; ab < kSamplesPerEdge * kSamplesPerEdge; ++ab)
        if (sample_labels_[ab][kSamplesPerEdge * k + c] >= 0) mask |= std::uint64_t{1} << (ab + 16 * c);
    return mask;
  }

  /// The smaller label if two are equally frequent.
  int most_frequent_label(int k) const {
    std::vector<int> labels;
    for (const auto& column : sample_labels_)
      for (int c = 0; c < kSamplesPerEdge; ++c)
        if (column[kSamplesPerEdge * k + c] >= 0) labels.push_back(column[kSamplesPerEdge * k + c]);
    std::sort(labels.begin(), labels.end());
    int best = labels.front();
    std::ptrdiff_t best_count = 0;
    for (auto begin = labels.begin(); begin != labels.end();) {
      const auto end = std::upper_bound(begin, labels.end(), *begin);
      if (end - begin > best_count) {
        best_count = end - begin;
        best = *begin;
      }
      begin = end;
    }
    return best;
  }

  const Shape& shape_;
  const Lattice& lattice_;
  std::vector<double> centre_z_, sample_z_;
  std::vector<int> centre_labels_;
  std::array<std::vector<int>, kSamplesPerEdge * kSamplesPerEdge> sample_labels_;
};

std::vector<Voxel> sample_voxels(const Shape& shape, const Lattice& lattice) {
  std::vector<Voxel> voxels;
  ColumnSampler sampler(shape, lattice);
  for (int j = 0; j < lattice.size.y(); ++j) {
    for (int i = 0; i < lattice.size.x(); ++i) {
      sampler.sample(i, j);
      sampler.append_voxels(i, j, voxels);
    }
  }
  std::sort(voxels.begin(), voxels.end(),
            [&](const Voxel& a, const Voxel& b) { return lattice.index(a.index) < lattice.index(b.index); });
  return voxels;
}

}  // namespace

VoxelVolume VoxelVolume::sample(const Shape& shape, const Vec3& spacing, std::int64_t max_voxels) {
  VoxelVolume volume;
  volume.lattice_ = covering_lattice(shape.bounds(), spacing, max_voxels);
  volume.voxels_ = sample_voxels(shape, volume.lattice_);
  if (std::none_of(volume.voxels_.begin(), volume.voxels_.end(), [](const Voxel& v) { return v.linked(); }))
    refuse_too_large(spacing, shape.bounds().sizes());
  volume.host_unlinked_voxels();
  volume.link_voxels(shape);
  return volume;
}

void VoxelVolume::number_voxels() {
  voxel_of_cell_.assign(lattice_.count(), -1);
  for (std::size_t v = 0; v < voxels_.size(); ++v)
    voxel_of_cell_[lattice_.index(voxels_[v].index)] = static_cast<int>(v);
}

int VoxelVolume::best_filled_linked(const Vec3i& index, int max_steps) const {
  int best = -1;
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        if (std::abs(i) + std::abs(j) + std::abs(k) > max_steps) continue;
        const int v = find(index + Vec3i(i, j, k));
        if (v < 0 || !voxels_[v].linked()) continue;
        if (best < 0 || voxels_[v].fill.fraction() > voxels_[best].fill.fraction()) best = v;
      }
    }
  }
  return best;
}

int VoxelVolume::find_host(const Vec3i& index) const {
  const int across_face = best_filled_linked(index, 1);
  return across_face >= 0 ? across_face : best_filled_linked(index, 3);
}

void VoxelVolume::host_unlinked_voxels() {
  number_voxels();
  const auto has_no_host = [&](const Voxel& voxel) { return !voxel.linked() && find_host(voxel.index) < 0; };
  std::vector<Voxel> kept;
  kept.reserve(voxels_.size());
  for (const Voxel& voxel : voxels_) {
    if (has_no_host(voxel))
      dropped_volume_ += voxel.fill.fraction() * lattice_.spacing.prod();
    else
      kept.push_back(voxel);
  }
  voxels_ = std::move(kept);
  number_voxels();
  for (Voxel& voxel : voxels_)
    if (!voxel.linked()) voxel.host = find_host(voxel.index);
}

void VoxelVolume::link_voxels(const Shape& shape) {
  std::array<int, kDirections> no_crossings;
  no_crossings.fill(-1);
  crossing_of_link_.assign(voxels_.size(), no_crossings);
  for (int v = 0; v < static_cast<int>(voxels_.size()); ++v)
    for (int direction = 0; direction < kDirections; ++direction) link_across(v, direction, shape);
}

void VoxelVolume::link_across(int v, int direction, const Shape& shape) {
  Voxel& voxel = voxels_[v];
  const Vec3i next = voxel.index + step(direction);
  const int other = find(next);
  const bool meets_linked = other >= 0 && voxels_[other].linked();
  voxel.neighbour[direction] = meets_linked ? other : -1;
  voxel.link[direction] = meets_linked ? LinkState::kIntact : LinkState::kSurface;
  if (!voxel.linked()) return;
  if (meets_linked) {
    link_count_ += direction % 2;
    return;
  }
  const SurfacePoint exit = shape.exit(centre(v), lattice_.centre(next));
  set_crossing(v, direction, {point_on_link(v, direction, exit.point), exit.normal});
}

}  // namespace cfem_cutting
