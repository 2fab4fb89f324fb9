#include "cfem_cutting/elasticity/elastic_model.h"

#include <atomic>
#include <string>

#include "cfem_cutting/geometry/errors.h"
#include "element_matrix.h"
#include "rotation.h"

namespace cfem_cutting {
namespace {

using Positions = Eigen::Matrix<double, 3, 8>;  // m

/// Positions of an element's nodes relative to its first node: keeps rigid motion free of rounding at large
/// coordinates.
Positions local_positions(const CompositeElement& element, const NodeField& x) {
  Positions local;
  for (int n = 0; n < 8; ++n) local.col(n) = x.col(element.nodes[n]) - x.col(element.nodes[0]);
  return local;
}

std::uint64_t next_version() {
  static std::atomic<std::uint64_t> counter{0};
  return ++counter;
}

/// Nodal forces on the co-rotated element, K u.
Positions rest_frame_forces(const ElementMatrix& K, const Positions& displacement) {
  Positions forces;
  Eigen::Map<Eigen::Matrix<double, 24, 1>>(forces.data()).noalias() =
      K * Eigen::Map<const Eigen::Matrix<double, 24, 1>>(displacement.data());
  return forces;
}

}  // namespace

/// Rest data per element, and what builds it.
struct ElasticModel::Matrices {
  Matrices(const VoxelVolume& volume, int mesh_level, const std::vector<Material>& materials,
           ElementKind kind)
      : level(mesh_level),
        block_volume(volume.lattice().spacing.prod() * (1 << (3 * mesh_level))),
        assembler(volume.lattice().spacing * (1 << mesh_level), materials, kind),
        material_count(static_cast<int>(materials.size())) {
    Fill full;
    full.mask = ~std::uint64_t{0};
    for (int m = 0; m < material_count; ++m) {
      std::vector<BlockWeights> weights(material_count, BlockWeights::Zero());
      weights[m] = voxel_weights(Vec3i::Zero(), 0, full, block_volume);
      full_block.push_back(std::make_shared<const ElementData>(assembler.assemble(weights, weights)));
    }
  }

  /// The material of a full block of one material, −1 for all other elements.
  int full_block_material(const VoxelVolume& volume, const CompositeElement& element) const {
    if (static_cast<int>(element.voxels.size()) != 1 << (3 * level)) return -1;
    const int material = material_of_voxel[element.voxels.front()];
    for (int v : element.voxels)
      if (!volume.voxel(v).fill.full() || material_of_voxel[v] != material) return -1;
    return material;
  }

  std::shared_ptr<const ElementData> build(const VoxelVolume& volume, const CompositeMesh& mesh,
                                           const CompositeElement& element) const {
    const int full_material = full_block_material(volume, element);
    if (full_material >= 0) return full_block[full_material];
    const Vec3i first = mesh.first_voxel() + element.block * (1 << level);
    std::vector<BlockWeights> weights(material_count, BlockWeights::Zero());
    std::vector<BlockWeights> mass_weights = weights;
    for (int v : element.voxels) {
      const Vec3i sub = volume.voxel(v).index - first;
      const Vec3i nearest = sub.cwiseMax(0).cwiseMin((1 << level) - 1);
      const Fill& fill = volume.voxel(v).fill;
      weights[material_of_voxel[v]] += voxel_weights(sub, level, fill, block_volume);
      mass_weights[material_of_voxel[v]] += voxel_weights(nearest, level, fill, block_volume);
    }
    return std::make_shared<const ElementData>(assembler.assemble(weights, mass_weights));
  }

  /// Builds the elements of a mesh, taking over those that have the same voxels as before.
  void rebuild(const VoxelVolume& volume, const CompositeMesh& mesh, const CompositeMesh* before) {
    std::vector<std::shared_ptr<const ElementData>> data;
    data.reserve(mesh.elements().size());
    for (const CompositeElement& element : mesh.elements()) {
      const int old = before ? before->element_of_voxel(element.voxels.front()) : -1;
      const bool kept = old >= 0 && before->elements()[old].voxels == element.voxels;
      data.push_back(kept ? of_element[old] : build(volume, mesh, element));
    }
    of_element = std::move(data);
  }

  PolarRotation rotation(int element, const Positions& local) const {
    return polar_rotation(local * of_element[element]->mean_gradient.transpose());
  }

  int level;
  double block_volume;  // m³
  ElementAssembler assembler;
  int material_count;
  std::vector<int> material_of_voxel;
  std::vector<std::shared_ptr<const ElementData>> full_block;  // per material
  std::vector<std::shared_ptr<const ElementData>> of_element;
  std::atomic<int> inverted{0};
};

ElasticModel::ElasticModel(const VoxelVolume& volume, int level, std::vector<Material> materials,
                           ElementKind kind, Kinematics kinematics)
    : level_(level), materials_(std::move(materials)), kind_(kind), kinematics_(kinematics) {
  matrices_ = std::make_unique<Matrices>(volume, level_, materials_, kind_);
  for (std::size_t v = 0; v < volume.voxels().size(); ++v) {
    const int label = volume.voxels()[v].label;
    const int material = match_material(materials_, label);
    if (material < 0)
      throw ConfigError("materials: the tissue has label " + std::to_string(label) +
                        ", which no material matches");
    matrices_->material_of_voxel.push_back(material);
    voxel_mass_.push_back(materials_[material].density * volume.filled_volume(static_cast<int>(v)));
  }
  mesh_ = std::make_unique<CompositeMesh>(volume, level_);
  matrices_->rebuild(volume, *mesh_, nullptr);
  lump_masses();
}

ElasticModel::~ElasticModel() = default;

std::vector<int> ElasticModel::update(const VoxelVolume& volume) {
  auto mesh = std::make_unique<CompositeMesh>(volume, level_);
  std::vector<int> parents = parent_nodes(*mesh_, *mesh);
  matrices_->rebuild(volume, *mesh, mesh_.get());
  mesh_ = std::move(mesh);
  lump_masses();
  return parents;
}

void ElasticModel::lump_masses() {
  mass_ = Eigen::VectorXd::Zero(mesh_->node_count());
  for (std::size_t e = 0; e < mesh_->elements().size(); ++e)
    for (int n = 0; n < 8; ++n) mass_[mesh_->elements()[e].nodes[n]] += matrices_->of_element[e]->mass[n];
  version_ = next_version();
}

double ElasticModel::energy(const NodeField& x) const {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh_->elements().size(); ++e) {
    const CompositeElement& element = mesh_->elements()[e];
    const Positions local = local_positions(element, x);
    Positions u = local;
    if (kinematics_ == Kinematics::kCorotational)
      u = matrices_->rotation(static_cast<int>(e), local).R.transpose() * local;
    u -= local_positions(element, mesh_->rest());
    sum += 0.5 * u.cwiseProduct(rest_frame_forces(matrices_->of_element[e]->stiffness, u)).sum();
  }
  return sum;
}

/// With y = Rᵀx, f = K(y − X): dE = f·Rᵀdx + f·dRᵀx, dR = R[ω]×, hence f·dRᵀx = −ω·t with t = Σ yₙ × fₙ.
/// The skew part of RᵀdF = d(RᵀF) + [ω]×S gives (tr(S) I − S) ω = Σ gₙ × Rᵀdxₙ for S = RᵀF, F = Σ xₙ gₙᵀ.
/// So ∂E/∂xₙ = R (fₙ − q × gₙ) with (tr(S) I − S) q = t.
NodeField ElasticModel::forces(const NodeField& x) const {
  NodeField sum = NodeField::Zero(3, x.cols());
  for (std::size_t e = 0; e < mesh_->elements().size(); ++e) {
    const CompositeElement& element = mesh_->elements()[e];
    const ElementData& data = *matrices_->of_element[e];
    const Positions local = local_positions(element, x);
    const Positions rest = local_positions(element, mesh_->rest());
    Positions gradient;
    if (kinematics_ == Kinematics::kLinear) {
      gradient = rest_frame_forces(data.stiffness, local - rest);
    } else {
      const Mat3 R = matrices_->rotation(static_cast<int>(e), local).R;
      const Positions y = R.transpose() * local;
      Positions f = rest_frame_forces(data.stiffness, y - rest);
      Vec3 torque = Vec3::Zero();
      for (int n = 0; n < 8; ++n) torque += y.col(n).cross(f.col(n));
      const Vec3 q = solve_spin(y * data.mean_gradient.transpose(), torque);
      for (int n = 0; n < 8; ++n) f.col(n) -= q.cross(Vec3(data.mean_gradient.col(n)));
      gradient = R * f;
    }
    for (int n = 0; n < 8; ++n) sum.col(element.nodes[n]) -= gradient.col(n);
  }
  return sum;
}

std::vector<Mat3> ElasticModel::rotations(const NodeField& x) const {
  std::vector<Mat3> rotations(mesh_->elements().size(), Mat3::Identity());
  matrices_->inverted = 0;
  if (kinematics_ == Kinematics::kLinear) return rotations;
  int inverted = 0;
  for (std::size_t e = 0; e < rotations.size(); ++e) {
    const PolarRotation polar =
        matrices_->rotation(static_cast<int>(e), local_positions(mesh_->elements()[e], x));
    rotations[e] = polar.R;
    inverted += polar.inverted;
  }
  matrices_->inverted = inverted;
  return rotations;
}

std::shared_ptr<const ElementMatrix> ElasticModel::shared_stiffness(int element) const {
  const auto& data = matrices_->of_element[element];
  return {data, &data->stiffness};
}

int ElasticModel::inverted_elements() const { return matrices_->inverted; }

}  // namespace cfem_cutting
