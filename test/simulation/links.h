#pragma once
/// Severed links compared.

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting::test {

/// Links that only one of two sorted lists has.
inline std::vector<LinkId> difference(const std::vector<LinkId>& a, const std::vector<LinkId>& b) {
  std::vector<LinkId> links;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(links));
  return links;
}

/// How many links that only one of two cuts from above has lie in one column of voxels (equal x and y), at
/// most: 1 if the cuts differ by no more than the last layer.
inline int layers_apart(const VoxelVolume& volume, const std::vector<LinkId>& a,
                        const std::vector<LinkId>& b) {
  std::map<std::pair<int, int>, int> layers;
  int most = 0;
  for (const LinkId& link : difference(a, b)) {
    const Vec3i& index = volume.voxel(link.voxel).index;
    most = std::max(most, ++layers[{index.x(), index.y()}]);
  }
  return most;
}

}  // namespace cfem_cutting::test
