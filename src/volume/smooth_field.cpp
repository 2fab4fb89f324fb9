#include "smooth_field.h"

#include <cmath>

namespace cfem_cutting {
namespace {

constexpr double kRadiusInSigmas = 3.0;

int radius(double sigma_in_voxels) { return static_cast<int>(std::ceil(kRadiusInSigmas * sigma_in_voxels)); }

std::vector<float> gaussian(double sigma) {
  const int reach = radius(sigma);
  std::vector<float> weights;
  double sum = 0.0;
  for (int n = -reach; n <= reach; ++n) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * n * n / (sigma * sigma))));
    sum += weights.back();
  }
  for (float& weight : weights) weight = static_cast<float>(weight / sum);
  return weights;
}

}  // namespace

SmoothField::SmoothField(const Lattice& lattice, const Vec3i& first, const Vec3i& last, double sigma,
                         const std::function<bool(const Vec3i&)>& inside) {
  Vec3i margin;
  for (int axis = 0; axis < 3; ++axis) margin[axis] = radius(sigma / lattice.spacing[axis]) + 1;
  const Vec3i lower = first - margin;
  lattice_ = {lattice.corner(lower), lattice.spacing, last + margin - lower + Vec3i::Ones()};
  values_.assign(lattice_.count(), 0.0f);
  for (int k = first.z(); k <= last.z(); ++k)
    for (int j = first.y(); j <= last.y(); ++j)
      for (int i = first.x(); i <= last.x(); ++i)
        if (inside({i, j, k})) values_[lattice_.index(Vec3i(i, j, k) - lower)] = 1.0f;
  for (int axis = 0; axis < 3; ++axis) blur(axis, sigma / lattice.spacing[axis]);
}

void SmoothField::blur(int axis, double sigma_in_voxels) {
  const std::vector<float> weights = gaussian(sigma_in_voxels);
  const int reach = radius(sigma_in_voxels);
  const std::int64_t stride = lattice_.index(Vec3i::Unit(axis));
  std::vector<float> blurred(values_.size(), 0.0f);
  for (int k = 0; k < lattice_.size.z(); ++k) {
    for (int j = 0; j < lattice_.size.y(); ++j) {
      const std::int64_t row = lattice_.index({0, j, k});
      for (int shift = -reach; shift <= reach; ++shift) {
        const int at_row = axis == 1 ? j + shift : axis == 2 ? k + shift : 0;
        if (at_row < 0 || at_row >= lattice_.size[axis]) continue;
        const int begin = axis == 0 ? std::max(0, -shift) : 0;
        const int end =
            axis == 0 ? std::min(lattice_.size.x(), lattice_.size.x() - shift) : lattice_.size.x();
        const float weight = weights[shift + reach];
        const std::int64_t source = row + shift * stride;
        for (int i = begin; i < end; ++i) blurred[row + i] += weight * values_[source + i];
      }
    }
  }
  values_ = std::move(blurred);
}

double SmoothField::value(const Vec3& p) const {
  const Vec3 position = (p - lattice_.origin).cwiseQuotient(lattice_.spacing).array() - 0.5;
  const Vec3i lower = position.array().floor().cast<int>();
  const Vec3 t = position - lower.cast<double>();
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3i offset(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= offset[axis] ? t[axis] : 1.0 - t[axis];
    sum += weight * at(lower + offset);
  }
  return sum;
}

Vec3 SmoothField::gradient(const Vec3& p, double distance) const {
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = distance * Vec3::Unit(axis);
    gradient[axis] = (value(p + d) - value(p - d)) / (2.0 * distance);
  }
  return gradient;
}

}  // namespace cfem_cutting
