#include "contour.h"

#include <algorithm>
#include <iterator>

namespace cfem_cutting {
namespace {

/// Vertices at cuts stay where they were put as long as their sheets stay the same.
void keep_virtual_points(const DualCell& before, DualCell& after) {
  for (SheetGroup& group : after.groups)
    for (const SheetGroup& old : before.groups)
      if (old.sides == group.sides) {
        group.frozen = old.frozen;
        group.settled = old.settled;
      }
}

}  // namespace

std::int64_t Contour::key(const Vec3i& index) const {
  const Vec3i& size = volume_.lattice().size;
  return index.x() + 1 + (size.x() + 1) * (index.y() + 1 + std::int64_t{size.y() + 1} * (index.z() + 1));
}

int Contour::find(const Vec3i& index) const {
  if ((index.array() < -1).any() || (index.array() >= volume_.lattice().size.array()).any()) return -1;
  const auto found = cell_at_.find(key(index));
  return found == cell_at_.end() ? -1 : found->second;
}

std::array<Vec3i, 4> Contour::cells_around(int voxel, int direction) const {
  const int axis = direction / 2;
  const Vec3i u = Vec3i::Unit((axis + 1) % 3);
  const Vec3i w = Vec3i::Unit((axis + 2) % 3);
  const Vec3i lower = volume_.voxel(voxel).index - u - w - (direction % 2 ? 0 : 1) * Vec3i::Unit(axis);
  return {lower, lower + u, lower + u + w, lower + w};
}

bool Contour::update() {
  if (!contoured_) {
    contour_all();
    return true;
  }
  if (volume_.severed_count() == static_cast<std::int64_t>(severed_.size())) return false;
  std::vector<LinkId> severed = volume_.severed_links();
  std::vector<LinkId> fresh;
  std::set_difference(severed.begin(), severed.end(), severed_.begin(), severed_.end(),
                      std::back_inserter(fresh));
  contour_around(fresh);
  severed_ = std::move(severed);
  return true;
}

void Contour::contour_all() {
  contoured_ = true;
  severed_ = volume_.severed_links();
  for (int v = 0; v < static_cast<int>(volume_.voxels().size()); ++v) {
    if (!volume_.voxel(v).linked()) continue;
    for (int direction = 0; direction < kDirections; ++direction) {
      if (volume_.voxel(v).link[direction] == LinkState::kIntact) continue;
      sides_.push_back(kDirections * v + direction);
      for (const Vec3i& index : cells_around(v, direction))
        if (find(index) < 0) contour(index);
    }
  }
}

void Contour::contour_around(const std::vector<LinkId>& links) {
  const auto old_end = static_cast<std::ptrdiff_t>(sides_.size());
  std::vector<Vec3i> touched;
  for (const LinkId& link : links) {
    const int forward = 2 * link.axis + 1;
    sides_.push_back(kDirections * link.voxel + forward);
    sides_.push_back(kDirections * volume_.voxel(link.voxel).neighbour[forward] + opposite(forward));
    for (const Vec3i& index : cells_around(link.voxel, forward)) touched.push_back(index);
  }
  std::sort(sides_.begin() + old_end, sides_.end());
  std::inplace_merge(sides_.begin(), sides_.begin() + old_end, sides_.end());
  const auto before = [&](const Vec3i& a, const Vec3i& b) { return key(a) < key(b); };
  std::sort(touched.begin(), touched.end(), before);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const Vec3i& index : touched) contour(index);
}

void Contour::contour(const Vec3i& index) {
  DualCell cell = contour_cell(volume_, index);
  const auto [place, inserted] = cell_at_.try_emplace(key(index), static_cast<int>(cells_.size()));
  if (inserted) {
    cells_.push_back(std::move(cell));
    return;
  }
  keep_virtual_points(cells_[place->second], cell);
  cells_[place->second] = std::move(cell);
}

}  // namespace cfem_cutting
