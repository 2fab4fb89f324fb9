#include "corotation.h"

#include <algorithm>
#include <unordered_map>

#include "corotation_kernel.h"
#include "rotation.h"

namespace cfem_cutting {
namespace {

using Positions = Eigen::Matrix<double, 3, 8>;  // m

/// Positions of an element's nodes relative to its first node: keeps rigid motion free of rounding at large
/// coordinates.
Positions local_positions(const ElementNodes& nodes, const NodeField& x) {
  Positions local;
  for (int n = 0; n < 8; ++n) local.col(n) = x.col(nodes[n]) - x.col(nodes[0]);
  return local;
}

Positions rest_positions(const Vec3& block_size) {
  Positions rest;
  for (int n = 0; n < 8; ++n) rest.col(n) = corner_bits(n).cast<double>().cwiseProduct(block_size);
  return rest;
}

/// Nodal forces on the co-rotated element, K u.
Positions rest_frame_forces(const ElementMatrix& K, const Positions& displacement) {
  Positions forces;
  Eigen::Map<Eigen::Matrix<double, 24, 1>>(forces.data()).noalias() =
      K * Eigen::Map<const Eigen::Matrix<double, 24, 1>>(displacement.data());
  return forces;
}

}  // namespace

/// Sums over the elements of a batch.
struct Corotation::Totals {
  double energy = 0.0;
  int inverted = 0;
};

Corotation::Corotation(ElementsPointer elements, std::vector<const MeanGradient*> gradients,
                       const Vec3& block_size, Kinematics kinematics)
    : elements_(std::move(elements)),
      gradient_(std::move(gradients)),
      block_size_(block_size),
      kinematics_(kinematics),
      stiffness_(*elements_) {
  pack_gradients();
}

void Corotation::pack_gradients() {
  const ElementTiles& tiles = elements_->tiles;
  std::unordered_map<const double*, std::size_t> known;
  for (int b = 0; b < tiles.size(); ++b) {
    const ElementTiles::Batch& batch = tiles.batches[b];
    const auto [place, added] = known.try_emplace(stiffness_.of_batch(b), packed_gradient_.size());
    gradient_of_batch_.push_back(place->second);
    if (!added) continue;
    for (int i = 0; i < 24; ++i)
      for (int lane = 0; lane < kLanes; ++lane)
        packed_gradient_.push_back(
            gradient_[tiles.element_of_lane[batch.first + std::min(lane, batch.count - 1)]]->data()[i]);
  }
}

void Corotation::respond(const NodeField& x, ThreadPool& pool, ElasticResponse& response) const {
  const ElementTiles& tiles = elements_->tiles;
  response.forces.resize(3, x.cols());
  response.rotations.resize(elements_->set.size());
  std::vector<Totals> totals(tiles.size());
  tiles.sum_up<double>(
      pool, [&](int b, double* forces) { totals[b] = respond_batch(b, x, forces, response.rotations); },
      [&](int node, const Eigen::Vector4d& sum) { response.forces.col(node) = sum.head<3>(); });
  response.energy = 0.0;
  response.inverted = 0;
  for (const Totals& of_batch : totals) {
    response.energy += of_batch.energy;
    response.inverted += of_batch.inverted;
  }
}

Corotation::Totals Corotation::respond_batch(int b, const NodeField& x, double* forces,
                                             std::vector<Mat3>& rotation_of_element) const {
  const ElementTiles& tiles = elements_->tiles;
  const ElementTiles::Batch& batch = tiles.batches[b];
  double rotations[9 * kLanes], energy[kLanes];
  bool regular[kLanes] = {};
  if (kinematics_ == Kinematics::kCorotational)
    cfem_cutting::respond({x.data(), tiles.nodes_of(b), packed_gradient_.data() + gradient_of_batch_[b],
                           block_size_.data(), stiffness_.form(b), stiffness_.of_batch(b), forces, rotations,
                           energy, regular});
  Totals totals;
  for (int lane = 0; lane < batch.count; ++lane) {
    const int e = tiles.element_of_lane[batch.first + lane];
    if (!regular[lane])
      totals.inverted +=
          respond_singly(e, x, forces + 4 * place_of_lane(lane), rotations + lane, energy[lane]);
    totals.energy += energy[lane];
    for (int i = 0; i < 9; ++i) rotation_of_element[e](i / 3, i % 3) = rotations[i * kLanes + lane];
  }
  return totals;
}

/// With y = Rᵀx, f = K(y − X): dE = f·Rᵀdx + f·dRᵀx, dR = R[ω]×, hence f·dRᵀx = −ω·t with t = Σ yₙ × fₙ.
/// The skew part of RᵀdF = d(RᵀF) + [ω]×S gives (tr(S) I − S) ω = Σ gₙ × Rᵀdxₙ for S = RᵀF, F = Σ xₙ gₙᵀ.
/// So ∂E/∂xₙ = R (fₙ − q × gₙ) with (tr(S) I − S) q = t.
/// @return whether the element is flat or inverted
bool Corotation::respond_singly(int element, const NodeField& x, double* force, double* rotation,
                                double& energy) const {
  const Positions local = local_positions(elements_->set.nodes[element], x);
  const MeanGradient& g = *gradient_[element];
  const bool turns = kinematics_ == Kinematics::kCorotational;
  const PolarRotation polar =
      turns ? polar_rotation(local * g.transpose()) : PolarRotation{Mat3::Identity(), false};
  const Mat3& R = polar.R;
  const Positions y = R.transpose() * local;
  const Positions u = y - rest_positions(block_size_);
  Positions f = rest_frame_forces(elements_->set.stiffness[element]->whole, u);
  energy = 0.5 * u.cwiseProduct(f).sum();
  if (turns) {
    Vec3 torque = Vec3::Zero();
    for (int n = 0; n < 8; ++n) torque += y.col(n).cross(f.col(n));
    const Vec3 q = solve_spin(y * g.transpose(), torque);
    for (int n = 0; n < 8; ++n) f.col(n) -= q.cross(Vec3(g.col(n)));
  }
  const Positions forces = -R * f;
  for (int n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i) force[4 * kLanes * n + i] = forces(i, n);
  for (int i = 0; i < 9; ++i) rotation[i * kLanes] = R(i / 3, i % 3);
  return polar.inverted;
}

}  // namespace cfem_cutting
