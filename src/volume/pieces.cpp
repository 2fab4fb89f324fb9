#include <algorithm>
#include <numeric>

#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {
namespace {

/// Gives all voxels that intact links join to `seed` the number `piece`.
void flood(const VoxelVolume& volume, int seed, int piece, std::vector<int>& piece_of_voxel) {
  std::vector<int> front{seed};
  piece_of_voxel[seed] = piece;
  while (!front.empty()) {
    const Voxel& voxel = volume.voxel(front.back());
    front.pop_back();
    for (int direction = 0; direction < kDirections; ++direction) {
      if (voxel.link[direction] != LinkState::kIntact) continue;
      const int next = voxel.neighbour[direction];
      if (piece_of_voxel[next] >= 0) continue;
      piece_of_voxel[next] = piece;
      front.push_back(next);
    }
  }
}

int flood_all(const VoxelVolume& volume, std::vector<int>& piece_of_voxel) {
  const int voxel_count = static_cast<int>(volume.voxels().size());
  piece_of_voxel.assign(voxel_count, -1);
  int piece_count = 0;
  for (int v = 0; v < voxel_count; ++v)
    if (volume.voxel(v).linked() && piece_of_voxel[v] < 0) flood(volume, v, piece_count++, piece_of_voxel);
  for (int v = 0; v < voxel_count; ++v)
    if (!volume.voxel(v).linked()) piece_of_voxel[v] = piece_of_voxel[volume.voxel(v).host];
  return piece_count;
}

/// Renumbers by falling volume; equal pieces stay in the order of their lowest voxels.
void sort_by_volume(Pieces& pieces) {
  std::vector<int> order(pieces.volumes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pieces.volumes[a] > pieces.volumes[b]; });
  std::vector<int> new_number(order.size());
  std::vector<double> sorted_volumes;
  for (std::size_t n = 0; n < order.size(); ++n) {
    new_number[order[n]] = static_cast<int>(n);
    sorted_volumes.push_back(pieces.volumes[order[n]]);
  }
  for (int& piece : pieces.piece_of_voxel) piece = new_number[piece];
  pieces.volumes = std::move(sorted_volumes);
}

}  // namespace

Pieces find_pieces(const VoxelVolume& volume) {
  Pieces pieces;
  const int piece_count = flood_all(volume, pieces.piece_of_voxel);
  std::vector<std::int64_t> filled_samples(piece_count, 0);
  for (std::size_t v = 0; v < volume.voxels().size(); ++v)
    filled_samples[pieces.piece_of_voxel[v]] += __builtin_popcountll(volume.voxels()[v].fill.mask);
  const double sample_volume = volume.lattice().spacing.prod() / 64.0;
  for (const std::int64_t samples : filled_samples) pieces.volumes.push_back(samples * sample_volume);
  sort_by_volume(pieces);
  return pieces;
}

}  // namespace cfem_cutting
