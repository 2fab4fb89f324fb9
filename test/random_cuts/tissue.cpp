#include "tissue.h"

#include <map>

#include "cfem_cutting/volume/shapes.h"
#include "surface/ball.h"

namespace cfem_cutting::random_cuts {
namespace {

Vec3 random_spacing(Dice& dice, bool dyadic) {
  Vec3 spacing = Vec3::Constant(dyadic ? 0x1.0p-8 : dice.log_uniform(0.001, 1.0));
  const bool cubic = dice.chance(0.5);
  for (double& h : spacing)
    if (!cubic) h *= dyadic ? dice.integer(1, 2) : dice.uniform(0.7, 1.4);
  return spacing;
}

/// Whole voxels, or turned and shifted at will.
VoxelVolume random_box(Dice& dice, const Vec3& spacing) {
  const bool turned = dice.chance(0.5);
  const int least = turned ? 10 : 8;  // voxels across, else too coarse for its edges
  const Vec3 voxels(dice.integer(least, 14), dice.integer(least, 12), dice.integer(least, 10));
  Pose X_TS = Pose::Identity();
  if (!turned) return VoxelVolume::sample(*make_box(voxels.cwiseProduct(spacing), X_TS), spacing);
  X_TS.translate(dice.vector(5.0 * spacing.maxCoeff()));
  X_TS.rotate(dice.rotation());
  return VoxelVolume::sample(*make_box(voxels * spacing.maxCoeff(), X_TS), spacing);
}

VoxelVolume random_ball(Dice& dice, const Vec3& spacing) {
  const double radius = dice.uniform(6.0, 7.5) * spacing.maxCoeff();
  return VoxelVolume::sample(test::Ball(radius, dice.vector(5.0 * spacing.maxCoeff())), spacing);
}

/// One of a few, as sampling a fine mesh takes longer than cutting it.
const VoxelVolume& random_bunny(Dice& dice, bool dyadic, const std::string& path) {
  static std::map<int, VoxelVolume> sampled;
  constexpr int kVariants = 2;
  const int variant = dice.integer(0, kVariants - 1) + (dyadic ? kVariants : 0);
  const auto found = sampled.find(variant);
  if (found != sampled.end()) return found->second;
  Dice own(variant);
  const Vec3 spacing = random_spacing(own, dyadic);
  static const TriangleMesh bunny = read_mesh(path);
  TriangleMesh mesh = bunny;
  Box bounds;
  for (const Vec3& vertex : mesh.vertices) bounds.extend(vertex);
  const double scale = own.integer(15, 18) * spacing.maxCoeff() / bounds.sizes().maxCoeff();
  Pose X_TS = Pose::Identity();
  X_TS.linear() = own.rotation();
  const auto shape = make_mesh_shape(std::move(mesh), scale, X_TS, path);
  return sampled.emplace(variant, VoxelVolume::sample(*shape, spacing)).first->second;
}

/// The voxels with all their corners.
void enclose(Tissue& tissue) {
  const Vec3 spacing = tissue.volume.lattice().spacing;
  Box centres;
  for (const Voxel& voxel : tissue.volume.voxels())
    centres.extend(tissue.volume.lattice().centre(voxel.index));
  tissue.centre = centres.center();
  tissue.radius = 0.0;
  for (const Voxel& voxel : tissue.volume.voxels()) {
    const Vec3 off = (tissue.volume.lattice().centre(voxel.index) - tissue.centre).cwiseAbs() + 0.5 * spacing;
    tissue.radius = std::max(tissue.radius, off.norm());
  }
}

}  // namespace

Tissue random_tissue(Dice& dice, bool dyadic, const std::string& bunny_path) {
  const int kind = dice.integer(0, 2);
  Tissue tissue;
  if (kind == 2) {
    tissue.name = "bunny";
    tissue.volume = random_bunny(dice, dyadic, bunny_path);
  } else {
    const Vec3 spacing = random_spacing(dice, dyadic);
    tissue.name = kind == 0 ? "box" : "ball";
    tissue.volume = kind == 0 ? random_box(dice, spacing) : random_ball(dice, spacing);
  }
  enclose(tissue);
  return tissue;
}

}  // namespace cfem_cutting::random_cuts
