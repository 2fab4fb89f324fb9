#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"
#include "cfem_cutting/elasticity/material.h"

namespace cfem_cutting {

enum class ElementKind { kIncompatibleModes, kTrilinear };
enum class Kinematics { kCorotational, kLinear };

using ElementMatrix = Eigen::Matrix<double, 24, 24>;  ///< N/m; row 3n + axis

/// Stiffness, mass and forces of a composite mesh. Rest matrices are shared between equal elements and kept
/// from one mesh to the next for elements that a cut did not touch.
class ElasticModel {
 public:
  /// @throw ConfigError a voxel's label has no material.
  ElasticModel(const VoxelVolume& volume, int level, std::vector<Material> materials, ElementKind kind,
               Kinematics kinematics);
  ~ElasticModel();

  /// Rebuilds mesh, matrices and masses after links were severed.
  /// @return the parent of each new node (see parent_nodes)
  std::vector<int> update(const VoxelVolume& volume);

  const CompositeMesh& mesh() const { return *mesh_; }
  const Eigen::VectorXd& mass() const { return mass_; }  ///< kg, lumped (|nodes|)
  double total_mass() const { return mass_.sum(); }
  double voxel_mass(int voxel) const { return voxel_mass_[voxel]; }

  /// Elastic energy at node positions x, J: Σ ½ uᵀ K u with u = Rᵀx − X per element.
  double energy(const NodeField& x) const;

  /// Elastic forces on the nodes, −∂energy/∂x, N: the true gradient, with ∂R/∂x.
  NodeField forces(const NodeField& x) const;

  /// Rotations of the elements at x (identity for linear kinematics).
  std::vector<Mat3> rotations(const NodeField& x) const;

  /// Stiffness matrix of an element at rest, N/m.
  const ElementMatrix& stiffness(int element) const { return *shared_stiffness(element); }

  /// The same as an object that equal elements share and that outlives updates.
  std::shared_ptr<const ElementMatrix> shared_stiffness(int element) const;

  /// Differs between any two states of any models in this process: changes with each update.
  std::uint64_t version() const { return version_; }

  /// Elements flat or inverted when rotations were computed last.
  int inverted_elements() const;

 private:
  struct Matrices;
  void lump_masses();
  int level_;
  std::vector<Material> materials_;
  ElementKind kind_;
  Kinematics kinematics_;
  std::unique_ptr<CompositeMesh> mesh_;
  std::unique_ptr<Matrices> matrices_;
  Eigen::VectorXd mass_;
  std::vector<double> voxel_mass_;
  std::uint64_t version_ = 0;
};

}  // namespace cfem_cutting
