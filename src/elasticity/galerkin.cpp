#include "galerkin.h"

#include <utility>

namespace cfem_cutting {
namespace {

std::uint32_t encode(const Vec3i& offset, std::uint32_t free_corners) {
  return static_cast<std::uint32_t>(offset.x() | offset.y() << 1 | offset.z() << 2) << 8 | free_corners;
}

Vec3i offset_of(std::uint32_t place) { return corner_bits(static_cast<int>(place >> 8)); }

}  // namespace

std::size_t GalerkinMatrices::Hash::operator()(const Parts& parts) const {
  std::size_t hash = parts.size();
  for (const Part& part : parts) {
    hash = hash * 0x9E3779B97F4A7C15u + std::hash<MatrixPointer>()(part.stiffness);
    hash = (hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u + part.place;
  }
  return hash;
}

ElementMatrix GalerkinMatrices::sum(const Parts& parts) {
  ElementMatrix sum = ElementMatrix::Zero();
  for (const Part& part : parts) {
    Eigen::Matrix<double, 8, 8> weights = Eigen::Matrix<double, 8, 8>::Zero();
    for (int n = 0; n < 8; ++n)
      if (part.place >> n & 1) weights.row(n) = corner_weights(offset_of(part.place), n);
    Eigen::Matrix<double, 24, 24> interpolation = Eigen::Matrix<double, 24, 24>::Zero();
    for (int n = 0; n < 8; ++n)
      for (int m = 0; m < 8; ++m)
        interpolation.block<3, 3>(3 * n, 3 * m).diagonal().setConstant(weights(n, m));
    sum.noalias() += interpolation.transpose() * (part.stiffness->whole * interpolation);
  }
  return sum;
}

std::vector<MatrixPointer> GalerkinMatrices::assemble(const ElementSet& fine, const std::vector<char>& held,
                                                      const Coarsening& coarsening) {
  std::vector<Parts> parts(coarsening.coarse.size());
  for (int e = 0; e < fine.size(); ++e) {
    std::uint32_t free_corners = 0;
    for (int n = 0; n < 8; ++n) free_corners |= (held[fine.nodes[e][n]] ? 0u : 1u) << n;
    const int c = coarsening.parent[e];
    const Vec3i offset = fine.block[e] - 2 * coarsening.coarse.block[c];
    parts[c].push_back({fine.stiffness[e], encode(offset, free_corners)});
  }
  std::unordered_map<Parts, MatrixPointer, Hash> used;
  std::vector<MatrixPointer> matrices;
  matrices.reserve(parts.size());
  for (Parts& of_element : parts) {
    const auto [entry, added] = used.try_emplace(std::move(of_element));
    if (added) {
      const auto before = known_.find(entry->first);
      entry->second =
          before != known_.end() ? before->second : std::make_shared<const RestMatrix>(sum(entry->first));
    }
    matrices.push_back(entry->second);
  }
  known_ = std::move(used);
  return matrices;
}

}  // namespace cfem_cutting
