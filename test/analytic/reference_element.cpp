#include "reference_element.h"

#include <Eigen/LU>
#include <cmath>

namespace cfem_cutting {
namespace {

using Strain = Eigen::Matrix<double, 6, 33>;  // of 8 nodes and 3 modes

struct Point {
  Vec3 xi;        // in the block, [−1, 1]³
  double weight;  // m³
  const Material* material;
};

std::vector<Point> integration_points(const VoxelVolume& volume, const CompositeMesh& mesh,
                                      const CompositeElement& element,
                                      const std::vector<Material>& materials) {
  std::vector<Point> points;
  const double voxels = 1 << mesh.level();
  const Vec3i first = mesh.first_voxel() + element.block * (1 << mesh.level());
  for (int v : element.voxels) {
    const Voxel& voxel = volume.voxel(v);
    const Vec3 start = (voxel.index - first).cast<double>();
    const Material* material = &materials[match_material(materials, voxel.label)];
    const int count = voxel.fill.full() ? 2 : 4;
    const double size = volume.lattice().spacing.prod() / std::pow(count, 3);
    for (int n = 0; n < count * count * count; ++n) {
      if (!((voxel.fill.mask >> n) & 1)) continue;
      Vec3 t((n % count + 0.5) / count, (n / count % count + 0.5) / count, (n / count / count + 0.5) / count);
      if (count == 2) t = Vec3::Constant(0.5) + (4.0 * (t.array() - 0.5) * 0.5 / std::sqrt(3.0)).matrix();
      points.push_back({2.0 * (start + t) / voxels - Vec3::Ones(), size, material});
    }
  }
  return points;
}

Vec3 shape_gradient(int node, const Vec3& xi, const Vec3& size) {
  const Vec3 s(node & 1 ? 1 : -1, node & 2 ? 1 : -1, node & 4 ? 1 : -1);
  const Vec3 f = Vec3::Ones() + s.cwiseProduct(xi);
  return 0.25 * Vec3(s.x() * f.y() * f.z(), f.x() * s.y() * f.z(), f.x() * f.y() * s.z()).cwiseQuotient(size);
}

Strain strain_matrix(const Vec3& xi, const Vec3& size) {
  Strain B = Strain::Zero();
  for (int n = 0; n < 11; ++n) {
    Vec3 g = Vec3::Zero();
    if (n < 8) {
      g = shape_gradient(n, xi, size);
    } else {
      g[n - 8] = -2.0 * xi[n - 8] * 2.0 / size[n - 8];  // of 1 − ξ²
    }
    B(0, 3 * n) = B(3, 3 * n + 1) = B(5, 3 * n + 2) = g.x();
    B(1, 3 * n + 1) = B(3, 3 * n) = B(4, 3 * n + 2) = g.y();
    B(2, 3 * n + 2) = B(4, 3 * n + 1) = B(5, 3 * n) = g.z();
  }
  return B;  // rows xx, yy, zz, xy, yz, zx
}

/// σ = C ε from λ and μ.
Eigen::Matrix<double, 6, 6> elasticity(const Material& m) {
  const double mu = m.young_modulus / (2.0 * (1.0 + m.poisson_ratio));
  const double lambda = 2.0 * mu * m.poisson_ratio / (1.0 - 2.0 * m.poisson_ratio);
  Eigen::Matrix<double, 6, 6> C = mu * Eigen::Matrix<double, 6, 6>::Identity();
  C.topLeftCorner<3, 3>() += mu * Mat3::Identity() + lambda * Mat3::Ones();
  return C;
}

}  // namespace

ElementMatrix reference_stiffness(const VoxelVolume& volume, const CompositeMesh& mesh, int element,
                                  const std::vector<Material>& materials, ElementKind kind) {
  const std::vector<Point> points = integration_points(volume, mesh, mesh.elements()[element], materials);
  Strain mean = Strain::Zero();
  double filled = 0.0;
  for (const Point& point : points) {
    mean += point.weight * strain_matrix(point.xi, mesh.block_size());
    filled += point.weight;
  }
  mean /= filled;
  mean.leftCols<24>().setZero();  // only the modes lose theirs
  Eigen::Matrix<double, 33, 33> K = Eigen::Matrix<double, 33, 33>::Zero();
  for (const Point& point : points) {
    const Strain B = strain_matrix(point.xi, mesh.block_size()) - mean;
    K += point.weight * B.transpose() * elasticity(*point.material) * B;
  }
  const ElementMatrix uu = K.topLeftCorner<24, 24>();
  if (kind == ElementKind::kTrilinear) return uu;
  const Eigen::FullPivLU<Eigen::Matrix<double, 9, 9>> aa(K.bottomRightCorner<9, 9>());
  return uu - K.topRightCorner<24, 9>() * aa.solve(K.bottomLeftCorner<9, 24>());
}

bool is_whole(const VoxelVolume& volume, const CompositeMesh& mesh, int element) {
  const std::vector<int>& voxels = mesh.elements()[element].voxels;
  bool whole = static_cast<int>(voxels.size()) == 1 << (3 * mesh.level());
  for (int v : voxels) whole = whole && volume.voxel(v).fill.full();
  return whole;
}

Eigen::Matrix<double, 24, 1> affine_displacement(const CompositeMesh& mesh, int element, const Mat3& G) {
  Eigen::Matrix<double, 24, 1> u;
  for (int n = 0; n < 8; ++n)
    u.segment<3>(3 * n) =
        G * (mesh.rest().col(mesh.elements()[element].nodes[n]) - mesh.block_corner(element));
  return u;
}

}  // namespace cfem_cutting
