#include "cfem_cutting/elasticity/inverse_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cfem_cutting/volume/inside.h"
#include "element_hash.h"
#include "trilinear_inverse.h"

namespace cfem_cutting {
namespace {

constexpr double kOnBoundary = 1e-9;  // of a block or a voxel
constexpr double kOverlap = 0.1;      // of a voxel

/// Elements with a linked voxel. (A hosted voxel alone is reached through its host's element.)
std::vector<int> linked_elements(const VoxelVolume& volume, const CompositeMesh& mesh) {
  std::vector<int> elements;
  for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
    const std::vector<int>& voxels = mesh.elements()[e].voxels;
    if (std::any_of(voxels.begin(), voxels.end(), [&](int v) { return volume.voxel(v).linked(); }))
      elements.push_back(static_cast<int>(e));
  }
  return elements;
}

Eigen::Matrix<double, 3, 8> corners_of(const CompositeMesh& mesh, const NodeField& x, int element) {
  Eigen::Matrix<double, 3, 8> corners;
  for (int n = 0; n < 8; ++n) corners.col(n) = x.col(mesh.elements()[element].nodes[n]);
  return corners;
}

Box voxel_box(const VoxelVolume& volume, int v) {
  const Vec3 corner = volume.lattice().corner(volume.voxel(v).index);
  return {corner, corner + volume.lattice().spacing};
}

/// The nearest linked voxel of an element, and the distance of X from its box (m).
std::pair<double, int> nearest_own_voxel(const VoxelVolume& volume, const CompositeElement& element,
                                         const Vec3& X) {
  std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), -1};
  for (int v : element.voxels)
    if (volume.voxel(v).linked()) nearest = std::min(nearest, {voxel_box(volume, v).exteriorDistance(X), v});
  return nearest;
}

/// How far X lies beyond a voxel's surface or severed link in a direction, along its normal, m; ≤ 0: on the
/// tissue's side.
double depth_beyond(const VoxelVolume& volume, int v, int direction, const Vec3& X) {
  if (volume.voxel(v).link[direction] == LinkState::kIntact) return -std::numeric_limits<double>::infinity();
  const SurfacePoint& crossing = volume.crossing(v, direction);
  return (X - crossing.point).dot(crossing.normal);
}

bool beyond(const VoxelVolume& volume, int v, int direction, const Vec3& X) {
  return depth_beyond(volume, v, direction, X) > kOnBoundary * volume.lattice().spacing.minCoeff();
}

bool beyond_skin(const VoxelVolume& volume, int v, const Vec3& X) {
  for (int direction = 0; direction < kDirections; ++direction)
    if (volume.voxel(v).link[direction] == LinkState::kSurface && beyond(volume, v, direction, X))
      return true;
  return false;
}

/// The nearest point to X in a voxel's tissue: in its box, then pushed onto the planes that it lies beyond.
Vec3 draw_back(const VoxelVolume& volume, int v, const Vec3& X) {
  const Box box = voxel_box(volume, v);
  Vec3 nearest = X.cwiseMax(box.min()).cwiseMin(box.max());
  for (int direction = 0; direction < kDirections; ++direction) {
    const double depth = depth_beyond(volume, v, direction, nearest);
    if (depth > 0.0) nearest -= depth * volume.crossing(v, direction).normal;
  }
  return nearest.cwiseMax(box.min()).cwiseMin(box.max());
}

}  // namespace

struct InverseMap::Hash {
  ElementHash elements;
};

InverseMap::InverseMap(const VoxelVolume& volume, const CompositeMesh& mesh, NodeField x, double reach)
    : volume_(volume), mesh_(mesh), x_(std::move(x)), reach_(reach) {
  hash_.reset(new Hash{ElementHash(mesh_, x_, linked_elements(volume_, mesh_))});
}

InverseMap::~InverseMap() = default;

Vec3 InverseMap::forward(const MaterialPoint& point) const {
  return mesh_.embed(point.voxel, point.X).apply(x_);
}

std::optional<MaterialPoint> InverseMap::operator()(const Vec3& x) const {
  std::optional<MaterialPoint> found;
  const double apart = kOverlap * volume_.lattice().spacing.minCoeff();
  hash_->elements.visit_at(x, [&](int element) {
    const std::optional<MaterialPoint> here = in_voxel_of(element, x);
    const bool again = here && found && here->inside && found->inside;
    if (again && (here->X - found->X).norm() > apart) {
      found->inside = found->near_links = false;
      return true;
    }
    if (here && (!found || (here->inside && !found->inside))) found = here;
    return false;
  });
  return found ? found : beside_tissue(x);  // which may be under the skin, in a voxel without links
}

/// The point if it lies in a linked voxel of this very element, and not in an open cut.
std::optional<MaterialPoint> InverseMap::in_voxel_of(int element, const Vec3& x) const {
  const std::optional<Vec3> X = pull_back(element, x, 0.5 + kOnBoundary);
  if (!X) return std::nullopt;
  const Vec3i first = mesh_.first_voxel() + mesh_.elements()[element].block * (1 << mesh_.level());
  const Vec3i last = first + Vec3i::Constant((1 << mesh_.level()) - 1);
  const int v = volume_.find(volume_.lattice().voxel_at(*X).cwiseMax(first).cwiseMin(last));
  if (v < 0 || !volume_.voxel(v).linked() || mesh_.element_of_voxel(v) != element) return std::nullopt;
  std::optional<MaterialPoint> owned = owner({*X, v}, x);
  if (owned) owned->inside = !beyond_skin(volume_, v, *X);
  if (owned) owned->near_links = true;
  return owned;
}

/// A point in a voxel, or in its part beyond a severed link, which belongs to the voxel across; nothing if it
/// isn't the latter's either, but in the gap between the two.
std::optional<MaterialPoint> InverseMap::owner(const MaterialPoint& point, const Vec3& x) const {
  const Voxel& voxel = volume_.voxel(point.voxel);
  MaterialPoint owner = point;
  for (int direction = 0; direction < kDirections; ++direction) {
    if (voxel.link[direction] != LinkState::kSevered || !beyond(volume_, point.voxel, direction, point.X))
      continue;
    const int across = voxel.neighbour[direction];
    const std::optional<Vec3> X = pull_back(mesh_.element_of_voxel(across), x, 1.0 + reach_);
    if (!X || beyond(volume_, across, opposite(direction), *X)) return std::nullopt;
    owner = {*X, across};
  }
  return owner;
}

std::optional<Vec3> InverseMap::pull_back(int element, const Vec3& x, double largest) const {
  const std::optional<Vec3> t = invert_trilinear(corners_of(mesh_, x_, element), x, largest);
  if (!t) return std::nullopt;
  return mesh_.block_corner(element) + t->cwiseProduct(mesh_.block_size());
}

/// The point in air, by the element whose tissue is nearest to it in material space.
std::optional<MaterialPoint> InverseMap::beside_tissue(const Vec3& x) const {
  const double reach = reach_ * mesh_.block_size().maxCoeff();
  double best = reach * (1.0 + kOnBoundary);
  std::optional<MaterialPoint> nearest;
  for (const auto& [bounds_distance, element] : hash_->elements.near(x, reach)) {
    const double least_stretch = 0.5;  // beyond a doubling of lengths, elements far off are not looked at
    if (least_stretch * bounds_distance > best) break;
    const std::optional<Vec3> X = pull_back(element, x, 1.0 + reach_);
    if (!X) continue;
    const auto [distance, v] = nearest_own_voxel(volume_, mesh_.elements()[element], *X);
    if (distance >= best) continue;
    best = distance;
    nearest = MaterialPoint{*X, v};
  }
  if (!nearest) return nearest;
  const int own = volume_.find(volume_.lattice().voxel_at(nearest->X));
  const int skin = own >= 0 && volume_.voxel(own).linked() ? -1 : skin_voxel_at(volume_, nearest->X);
  if (skin >= 0 && mesh_.element_of_voxel(skin) == mesh_.element_of_voxel(nearest->voxel))
    nearest = MaterialPoint{nearest->X, skin, true, true};
  if (in_tissue_of_another(*nearest)) nearest->X = draw_back(volume_, nearest->voxel, nearest->X);
  return nearest;
}

bool InverseMap::in_tissue_of_another(const MaterialPoint& point) const {
  const int there = volume_.find(volume_.lattice().voxel_at(point.X));
  return there >= 0 && volume_.voxel(there).linked() &&
         mesh_.element_of_voxel(there) != mesh_.element_of_voxel(point.voxel);
}

}  // namespace cfem_cutting
