#include "element_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace cfem_cutting {
namespace {

/// Quadratic Lagrange polynomials at 0, ½, 1.
Vec3 lagrange(double t) { return {(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)}; }

/// ∫ of the Lagrange polynomials over [a, b], by Simpson's rule (exact).
Vec3 lagrange_integral(double a, double b) {
  return (b - a) / 6.0 * (lagrange(a) + 4.0 * lagrange(0.5 * (a + b)) + lagrange(b));
}

void add_tensor(const Vec3& x, const Vec3& y, const Vec3& z, double factor, BlockWeights& sum) {
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b)
      for (int a = 0; a < 3; ++a) sum[a + 3 * (b + 3 * c)] += factor * x[a] * y[b] * z[c];
}

Eigen::Matrix<double, 6, 6> isotropic_elasticity(const Material& material) {
  const double E = material.young_modulus, nu = material.poisson_ratio;
  const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = E / (2.0 * (1.0 + nu));
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  C.diagonal() << lambda + 2.0 * mu, lambda + 2.0 * mu, lambda + 2.0 * mu, mu, mu, mu;
  return C;
}

/// Strains xx, yy, zz, yz, zx, xy (engineering) of three displacement components with this gradient.
Eigen::Matrix<double, 6, 3> strain_of_gradient(const Vec3& g) {
  Eigen::Matrix<double, 6, 3> B;
  B << g.x(), 0, 0, 0, g.y(), 0, 0, 0, g.z(), 0, g.z(), g.y(), g.z(), 0, g.x(), g.y(), g.x(), 0;
  return B;
}

/// A⁻¹ B of a symmetric positive matrix, scaled to unit diagonal; directions without stiffness (diagonal
/// below `zero`) are left out: the modes of an element with one sliver of tissue.
template <int N, int M>
Eigen::Matrix<double, N, M> solve_scaled(const Eigen::Matrix<double, N, N>& A,
                                         const Eigen::Matrix<double, N, M>& B, double zero) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const Vector scale = A.diagonal().unaryExpr([&](double d) { return d > zero ? 1.0 / std::sqrt(d) : 0.0; });
  const Eigen::Matrix<double, N, N> unit = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::Matrix<double, N, M> rhs = scale.asDiagonal() * B;
  const double smallest_pivot = 1e-8;
  const Eigen::LDLT<Eigen::Matrix<double, N, N>> factors(unit);
  if (factors.info() == Eigen::Success && factors.vectorD().minCoeff() > smallest_pivot)
    return scale.asDiagonal() * factors.solve(rhs);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(unit);
  const Vector inverse =
      eigen.eigenvalues().unaryExpr([&](double l) { return l > smallest_pivot ? 1.0 / l : 0.0; });
  return scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose() *
         rhs;
}

}  // namespace

BlockWeights voxel_weights(const Vec3i& sub, int level, const Fill& fill, double block_volume) {
  const double h = 1.0 / (1 << level);
  BlockWeights weights = BlockWeights::Zero();
  if (fill.full()) {
    std::array<Vec3, 3> integral;
    for (int axis = 0; axis < 3; ++axis)
      integral[axis] = lagrange_integral(sub[axis] * h, (sub[axis] + 1) * h);
    add_tensor(integral[0], integral[1], integral[2], block_volume, weights);
    return weights;
  }
  std::array<std::array<Vec3, 4>, 3> at;
  for (int axis = 0; axis < 3; ++axis)
    for (int s = 0; s < 4; ++s) at[axis][s] = lagrange((sub[axis] + (s + 0.5) / 4.0) * h);
  const double sample_volume = block_volume * h * h * h / 64.0;
  for (int n = 0; n < 64; ++n)
    if ((fill.mask >> n) & 1)
      add_tensor(at[0][n & 3], at[1][(n >> 2) & 3], at[2][n >> 4], sample_volume, weights);
  return weights;
}

struct ElementAssembler::Sums {
  double volume = 0.0;                         // m³
  FullMatrix stiffness = FullMatrix::Zero();   // ∫ BᵀCB
  StrainMatrix strain = StrainMatrix::Zero();  // ∫ B
  StrainMatrix stress = StrainMatrix::Zero();  // ∫ CB
  Elasticity elasticity = Elasticity::Zero();  // ∫ C
};

ElementAssembler::ElementAssembler(const Vec3& block_size, const std::vector<Material>& materials,
                                   ElementKind kind)
    : materials_(materials), kind_(kind), block_volume_(block_size.prod()) {
  for (int q = 0; q < 27; ++q) {
    const Vec3 t = 0.5 * Vec3(q % 3, (q / 3) % 3, q / 9);
    for (int n = 0; n < 8; ++n) {
      Vec3 value, slope;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = (n >> axis) & 1;
        value[axis] = upper ? t[axis] : 1.0 - t[axis];
        slope[axis] = (upper ? 1.0 : -1.0) / block_size[axis];
      }
      shape_[q][n] = value.prod();
      gradient_[q].col(n) << slope[0] * value[1] * value[2], value[0] * slope[1] * value[2],
          value[0] * value[1] * slope[2];
      strain_[q].middleCols<3>(3 * n) = strain_of_gradient(gradient_[q].col(n));
    }
    // Wilson's modes 1 − ξ² with ξ = 2t − 1.
    for (int axis = 0; axis < 3; ++axis)
      strain_[q].middleCols<3>(24 + 3 * axis) =
          strain_of_gradient(Vec3::Unit(axis) * (-4.0 * (2.0 * t[axis] - 1.0) / block_size[axis]));
  }
  for (const Material& material : materials_) {
    const Elasticity C = isotropic_elasticity(material);
    elasticity_.push_back(C);
    Eigen::MatrixXd products(kColumns * kColumns, 27);
    for (int q = 0; q < 27; ++q) {
      const FullMatrix product = strain_[q].transpose() * C * strain_[q];
      products.col(q) = Eigen::Map<const Eigen::VectorXd>(product.data(), product.size());
    }
    products_.push_back(std::move(products));
  }
  prepare_stabilisation();
}

/// A few samples leave modes of a partly filled element without energy. They get this part of a full block's
/// stiffness, as in the finite cell method, but only on the four hourglass patterns, so that affine fields
/// stay exact.
void ElementAssembler::prepare_stabilisation() {
  constexpr double kPart = 1e-3;
  ElementMatrix hourglass = ElementMatrix::Zero();
  for (int i = 0; i < 24; ++i) {
    for (int j = i % 3; j < 24; j += 3) {
      const int differ = (i / 3) ^ (j / 3);
      const double x = differ & 1 ? -1.0 : 1.0, y = differ & 2 ? -1.0 : 1.0, z = differ & 4 ? -1.0 : 1.0;
      hourglass(i, j) = (x * y + y * z + z * x + x * y * z) / 8.0;
    }
  }
  Fill full;
  full.mask = ~std::uint64_t{0};
  std::vector<ElementMatrix> stabilisation;
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    std::vector<BlockWeights> weights(materials_.size(), BlockWeights::Zero());
    weights[m] = voxel_weights(Vec3i::Zero(), 0, full, block_volume_);
    stabilisation.push_back(kPart * hourglass * assemble(weights, weights).stiffness.whole * hourglass);
  }
  stabilisation_ = std::move(stabilisation);
}

ElementAssembler::Sums ElementAssembler::integrate(const std::vector<BlockWeights>& weights) const {
  Sums sums;
  for (std::size_t m = 0; m < weights.size(); ++m) {
    const double volume = weights[m].sum();
    if (volume == 0.0) continue;
    StrainMatrix strain = StrainMatrix::Zero();
    for (int q = 0; q < 27; ++q) strain += weights[m][q] * strain_[q];
    sums.volume += volume;
    sums.strain += strain;
    sums.stress += elasticity_[m] * strain;
    sums.elasticity += volume * elasticity_[m];
    Eigen::Map<Eigen::VectorXd>(sums.stiffness.data(), sums.stiffness.size()).noalias() +=
        products_[m] * weights[m];
  }
  return sums;
}

/// Incompatible modes (Wilson et al. 1973; Taylor, Beresford and Wilson 1976): with the modes' mean strain M
/// over the filled volume taken off, constant stress does no work on them and the patch test holds for any
/// filling. K = K_uu − K_ua K_aa⁻¹ K_au.
ElementMatrix ElementAssembler::condense(const Sums& sums) const {
  const Eigen::Matrix<double, 6, kModes> mean = sums.strain.rightCols<kModes>() / sums.volume;
  const Eigen::Matrix<double, 6, kModes> mode_stress = sums.stress.rightCols<kModes>();
  const Eigen::Matrix<double, kModes, 24> K_au =
      sums.stiffness.bottomLeftCorner<kModes, 24>() - mean.transpose() * sums.stress.leftCols<24>();
  const Eigen::Matrix<double, kModes, kModes> cross = mean.transpose() * mode_stress;
  const Eigen::Matrix<double, kModes, kModes> K_aa = sums.stiffness.bottomRightCorner<kModes, kModes>() -
                                                     cross - cross.transpose() +
                                                     mean.transpose() * sums.elasticity * mean;
  const double zero = 1e-12 * sums.stiffness.diagonal().tail<kModes>().maxCoeff();  // below: rounding
  const Eigen::Matrix<double, kModes, 24> amplitudes = solve_scaled<kModes, 24>(K_aa, K_au, zero);
  return sums.stiffness.topLeftCorner<24, 24>() - K_au.transpose() * amplitudes;
}

ElementData ElementAssembler::assemble(const std::vector<BlockWeights>& weights,
                                       const std::vector<BlockWeights>& mass_weights) const {
  const Sums sums = integrate(weights);
  ElementData data;
  ElementMatrix K = kind_ == ElementKind::kTrilinear ? ElementMatrix(sums.stiffness.topLeftCorner<24, 24>())
                                                     : condense(sums);
  K = (0.5 * (K + K.transpose())).eval();
  if (sums.volume < (1.0 - 1e-9) * block_volume_)
    for (std::size_t m = 0; m < weights.size(); ++m)
      K += weights[m].sum() / block_volume_ * stabilisation_[m];
  data.stiffness = RestMatrix(K);
  data.mean_gradient.setZero();
  data.mass.setZero();
  for (std::size_t m = 0; m < weights.size(); ++m) {
    for (int q = 0; q < 27; ++q) {
      data.mean_gradient += weights[m][q] / sums.volume * gradient_[q];
      data.mass += materials_[m].density * mass_weights[m][q] * shape_[q];
    }
  }
  return data;
}

}  // namespace cfem_cutting
