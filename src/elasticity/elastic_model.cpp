#include "cfem_cutting/elasticity/elastic_model.h"

#include <atomic>
#include <string>

#include "cfem_cutting/geometry/errors.h"
#include "corotation.h"
#include "element_matrix.h"

namespace cfem_cutting {
namespace {

std::uint64_t next_version() {
  static std::atomic<std::uint64_t> counter{0};
  return ++counter;
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

  /// Elements of the multigrid's finest level.
  ElementSet element_set(const CompositeMesh& mesh) const {
    ElementSet set;
    set.node_count = mesh.node_count();
    for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
      set.block.push_back(mesh.elements()[e].block);
      set.nodes.push_back(mesh.elements()[e].nodes);
      set.stiffness.emplace_back(of_element[e], &of_element[e]->stiffness);
    }
    return set;
  }

  void arrange(const CompositeMesh& mesh, Kinematics kinematics) {
    std::vector<const MeanGradient*> gradients;
    for (const auto& data : of_element) gradients.push_back(&data->mean_gradient);
    corotation = Corotation(std::make_shared<TiledElements>(element_set(mesh)), std::move(gradients),
                            mesh.block_size(), kinematics);
  }

  int level;
  double block_volume;  // m³
  ElementAssembler assembler;
  int material_count;
  std::vector<int> material_of_voxel;
  std::vector<std::shared_ptr<const ElementData>> full_block;  // per material
  std::vector<std::shared_ptr<const ElementData>> of_element;
  Corotation corotation;
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
  }
  mesh_ = std::make_unique<CompositeMesh>(volume, level_);
  matrices_->rebuild(volume, *mesh_, nullptr);
  matrices_->arrange(*mesh_, kinematics_);
  lump_masses();
}

ElasticModel::~ElasticModel() = default;

std::vector<int> ElasticModel::update(const VoxelVolume& volume) {
  auto mesh = std::make_unique<CompositeMesh>(volume, level_);
  std::vector<int> parents = parent_nodes(*mesh_, *mesh);
  matrices_->rebuild(volume, *mesh, mesh_.get());
  mesh_ = std::move(mesh);
  matrices_->arrange(*mesh_, kinematics_);
  lump_masses();
  return parents;
}

void ElasticModel::lump_masses() {
  mass_ = Eigen::VectorXd::Zero(mesh_->node_count());
  for (std::size_t e = 0; e < mesh_->elements().size(); ++e)
    for (int n = 0; n < 8; ++n) mass_[mesh_->elements()[e].nodes[n]] += matrices_->of_element[e]->mass[n];
  version_ = next_version();
}

ElasticResponse ElasticModel::respond(const NodeField& x, ThreadPool* pool) const {
  ThreadPool caller_only(1);
  ElasticResponse response;
  respond(x, pool ? *pool : caller_only, response);
  return response;
}

void ElasticModel::respond(const NodeField& x, ThreadPool& pool, ElasticResponse& response) const {
  matrices_->corotation.respond(x, pool, response);
}

const ElementMatrix& ElasticModel::stiffness(int element) const {
  return matrices_->of_element[element]->stiffness.whole;
}

const ElementsPointer& ElasticModel::elements() const { return matrices_->corotation.elements(); }

}  // namespace cfem_cutting
