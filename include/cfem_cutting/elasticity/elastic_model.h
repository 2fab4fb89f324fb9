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

struct TiledElements;
class ThreadPool;

/// What elements answer at node positions x. Per element E = ½ uᵀ K u with u = Rᵀx − X.
struct ElasticResponse {
  double energy = 0.0;          ///< J
  NodeField forces;             ///< N, −∂energy/∂x: the true gradient, with ∂R/∂x
  std::vector<Mat3> rotations;  ///< of the elements (identity for linear kinematics)
  int inverted = 0;             ///< elements flat or inverted
};

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

  /// @param pool to work on several threads
  ElasticResponse respond(const NodeField& x, ThreadPool* pool = nullptr) const;
  /// Into a response whose memory is of use again.
  void respond(const NodeField& x, ThreadPool& pool, ElasticResponse& response) const;
  double energy(const NodeField& x) const { return respond(x).energy; }
  NodeField forces(const NodeField& x) const { return respond(x).forces; }
  std::vector<Mat3> rotations(const NodeField& x) const { return respond(x).rotations; }

  /// Stiffness matrix of an element at rest, N/m.
  const ElementMatrix& stiffness(int element) const;

  /// Elements with their nodes and matrices, for solvers.
  const std::shared_ptr<const TiledElements>& elements() const;

  /// Differs between any two states of any models in this process: changes with each update.
  std::uint64_t version() const { return version_; }

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
  std::uint64_t version_ = 0;
};

}  // namespace cfem_cutting
