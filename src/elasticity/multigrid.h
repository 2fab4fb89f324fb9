#pragma once

#include <deque>
#include <vector>

#include "cfem_cutting/elasticity/integrator.h"
#include "galerkin.h"
#include "largest_eigenvalue.h"
#include "level_system.h"
#include "prolongation.h"

namespace cfem_cutting {

/// What a system has besides its elements.
struct SystemValues {
  Eigen::VectorXd node_diagonal;  ///< N/m, added to each axis of a node
  double stiffness_factor = 1.0;
  const std::vector<PointConstraint>* constraints = nullptr;
};

/// A symmetric cycle over the composite hierarchy (Dick, Georgii and Westermann 2011): a preconditioner for A
/// = D + s Σ R K Rᵀ + Σ k (w ⊗ d)(w ⊗ d)ᵀ. Coarse elements have the rest matrices of what is in them
/// (Galerkin) and the mean of its rotations; the coarsest level is solved directly. Where inertia holds a
/// coarse level, it is a V-cycle with little work there; otherwise a W-cycle below the second level, and
/// where there is hardly any with more.
class Multigrid {
 public:
  explicit Multigrid(ThreadPool& pool) : pool_(pool) {}

  /// Takes over a model's mesh and which nodes are held, unless it has them already.
  void arrange(const ElasticModel& model, const std::vector<int>& held);

  /// Takes over rotations and values.
  void set(std::vector<Mat3>&& rotations, const SystemValues& values);

  /// Fits the smoothers to rotations that differ much from element to element. Until the next mesh.
  void adapt_smoothers();

  ThreadPool& pool() const { return pool_; }
  const LevelSystem& finest() const { return levels_.front().system; }

  /// z = one cycle for A z = r
  void precondition(const SingleField& r, SingleField& z) const { cycle(0, r, z); }

 private:
  struct Level {
    explicit Level(ThreadPool& pool) : system(pool) {}
    LevelSystem system;
    int cycles = 1;           // on this level, for each on the finer one
    std::vector<int> parent;  // coarse element of each element
    ElementParts parts;       // of each coarse element
    Interpolation interpolation, restriction;
    Prolongation prolongation;
    mutable SingleField coarse_load, coarse_x;
    mutable SingleField left, change;  // of the second cycle
  };
  void add_level(ElementsPointer elements, std::vector<char> held);
  void cycle(std::size_t level, const SingleField& b, SingleField& x) const;
  void cycle_again(std::size_t level, const SingleField& b, SingleField& x) const;
  void set_diagonals(const Eigen::VectorXd& finest, float stiffness_factor);
  std::vector<Mat3> coarse_rotations(const Level& fine) const;
  std::vector<ConstraintRow> coarse_constraints(const Level& fine, const ElementSet& coarse) const;

  ThreadPool& pool_;
  std::uint64_t version_ = 0;
  std::vector<int> held_;
  Eigen::VectorXd node_diagonal_;  // what the levels' diagonals are of; empty: not set yet
  float stiffness_factor_ = 0.0f;
  std::deque<Level> levels_;
  std::vector<GalerkinMatrices> galerkin_;  // kept from mesh to mesh
  std::vector<LargestEigenvalue> largest_;  // kept, too
};

}  // namespace cfem_cutting
