#include <Eigen/SVD>

#include "cfem_cutting/cutting/fracture.h"

namespace cfem_cutting {
namespace {

/// Weighted sums from which the best-fit rigid motion of a piece follows.
struct Moments {
  double weight = 0.0;
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  Mat3 product = Mat3::Zero();

  void add(double w, const Vec3& a, const Vec3& b) {
    weight += w;
    from += w * a;
    to += w * b;
    product += w * b * a.transpose();
  }
};

/// Least-squares rotation and translation (Kabsch 1976); pieces too thin to tell a rotation keep its part
/// that can be told.
Pose best_fit(const Moments& m) {
  Pose motion = Pose::Identity();
  if (m.weight <= 0.0) return motion;
  const Vec3 from = m.from / m.weight;
  const Vec3 to = m.to / m.weight;
  const Mat3 covariance = m.product / m.weight - to * from.transpose();
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  motion.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  motion.translation() = to - motion.linear() * from;
  return motion;
}

}  // namespace

OffsetField::OffsetField(const VoxelVolume& volume, const Pieces& pieces, const CompositeMesh& mesh,
                         const std::vector<char>& floating, const NodeField& reference,
                         const NodeField& current)
    : pieces_(pieces), mesh_(mesh), reference_(reference), current_(current) {
  std::vector<Moments> moments(pieces.count());
  for (const CompositeElement& element : mesh.elements()) {
    if (!floating[element.nodes[0]]) continue;
    const int piece = pieces.piece_of_voxel[element.voxels.front()];
    double weight = 0.0;
    for (const int voxel : element.voxels) weight += volume.filled_volume(voxel);
    // By its nodes, not its centre: they tell the rotation even of a piece that is a single element.
    for (const int node : element.nodes)
      moments[piece].add(weight / 8.0, reference.col(node), current.col(node));
  }
  for (const Moments& m : moments) rigid_motion_.push_back(best_fit(m));
}

double OffsetField::offset(int voxel, const Vec3& X) const {
  return offset_at(voxel, X, mesh_.embed(voxel, X).apply(current_));
}

double OffsetField::offset_at(int voxel, const Vec3& X, const Vec3& x) const {
  const Vec3 x_ref = mesh_.embed(voxel, X).apply(reference_);
  return (x - rigid_motion_[pieces_.piece_of_voxel[voxel]] * x_ref).norm();
}

}  // namespace cfem_cutting
