#include "cfem_cutting/volume/voxel_volume.h"

#include <algorithm>
#include <cassert>

namespace cfem_cutting {
namespace {

/// Crossings keep this part of a link away from its ends, so that no cell of the surface degenerates.
constexpr double kMargin = 0.02;

/// The unit normal with the sign that points along +axis; a normal square to the axis gets a sign of its own.
Vec3 orient_along(const Vec3& normal, int axis) {
  const double length = normal.norm();
  if (!(length > 0.0)) return Vec3::Unit(axis);
  const Vec3 unit = normal / length;
  for (const int component : {axis, (axis + 1) % 3, (axis + 2) % 3})
    if (unit[component] != 0.0) return unit[component] > 0.0 ? unit : Vec3(-unit);
  return Vec3::Unit(axis);
}

}  // namespace

int VoxelVolume::find(const Vec3i& index) const {
  return lattice_.contains(index) ? voxel_of_cell_[lattice_.index(index)] : -1;
}

const SurfacePoint& VoxelVolume::crossing(int v, int direction) const {
  assert(crossing_of_link_[v][direction] >= 0);
  return crossings_[crossing_of_link_[v][direction]];
}

Vec3 VoxelVolume::point_on_link(int v, int direction, const Vec3& X) const {
  const int axis = direction / 2;
  const double sign = direction % 2 ? 1.0 : -1.0;
  const double h = lattice_.spacing[axis];
  Vec3 point = centre(v);
  const double t = sign * (X[axis] - point[axis]) / h;
  point[axis] += sign * h * std::clamp(t, kMargin, 1.0 - kMargin);
  return point;
}

void VoxelVolume::set_crossing(int v, int direction, const SurfacePoint& crossing) {
  crossing_of_link_[v][direction] = static_cast<int>(crossings_.size());
  crossings_.push_back(crossing);
}

bool VoxelVolume::sever(LinkId link, const SurfacePoint& crossing) {
  const int forward = 2 * link.axis + 1;
  Voxel& lower = voxels_[link.voxel];
  assert(lower.linked() && lower.neighbour[forward] >= 0);
  if (lower.link[forward] != LinkState::kIntact) return false;

  const int upper = lower.neighbour[forward];
  lower.link[forward] = voxels_[upper].link[opposite(forward)] = LinkState::kSevered;
  ++severed_count_;
  const Vec3 point = point_on_link(link.voxel, forward, crossing.point);
  const Vec3 normal = orient_along(crossing.normal, link.axis);
  set_crossing(link.voxel, forward, {point, normal});
  set_crossing(upper, opposite(forward), {point, -normal});
  return true;
}

std::vector<LinkId> VoxelVolume::severed_links() const {
  std::vector<LinkId> severed;
  for (int v = 0; v < static_cast<int>(voxels_.size()); ++v)
    for (int axis = 0; axis < 3; ++axis)
      if (voxels_[v].linked() && voxels_[v].link[2 * axis + 1] == LinkState::kSevered)
        severed.push_back({v, axis});
  return severed;
}

}  // namespace cfem_cutting
