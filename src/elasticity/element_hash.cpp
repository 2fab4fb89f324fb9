#include "element_hash.h"

#include <algorithm>
#include <cmath>

namespace cfem_cutting {
namespace {

constexpr double kCellsPerElement = 8.0;

}  // namespace

ElementHash::ElementHash(const CompositeMesh& mesh, const NodeField& x, const std::vector<int>& elements)
    : boxes_(mesh.elements().size()) {
  Vec3 mean_size = Vec3::Zero();
  for (int e : elements) {
    for (int node : mesh.elements()[e].nodes) boxes_[e].extend(Vec3(x.col(node)));
    if (!boxes_[e].sizes().allFinite()) boxes_[e].setEmpty();
    if (boxes_[e].isEmpty()) continue;
    bounds_.extend(boxes_[e]);
    mean_size += boxes_[e].sizes() / static_cast<double>(elements.size());
  }
  if (!bounds_.isEmpty()) choose_cells(elements.size(), mean_size);

  first_.assign(size_.prod() + 1, 0);
  for (int e : elements) for_each_cell(boxes_[e], [&](int cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  elements_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int e : elements) for_each_cell(boxes_[e], [&](int cell) { elements_[next[cell]++] = e; });
}

/// Cells as large as the mean element, larger if pieces lie far apart.
void ElementHash::choose_cells(std::size_t count, const Vec3& mean_size) {
  cell_ = mean_size.cwiseMax(1e-9 * bounds_.sizes().maxCoeff()).cwiseMax(1e-300);
  const auto cells = [&] { return bounds_.sizes().cwiseQuotient(cell_).array().floor() + 1.0; };
  while (cells().prod() > kCellsPerElement * static_cast<double>(count) + 64.0) cell_ *= 1.26;
  size_ = cells().cast<int>();
}

Vec3i ElementHash::cell_of(const Vec3& x) const {
  const Vec3 t =
      (x - bounds_.min()).cwiseQuotient(cell_).cwiseMax(0.0).cwiseMin(size_.cast<double>() - Vec3::Ones());
  return t.array().floor().cast<int>();
}

template <typename Visit>
void ElementHash::for_each_cell(const Box& box, const Visit& visit) const {
  if (box.isEmpty()) return;
  const Vec3i low = cell_of(box.min()), high = cell_of(box.max());
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) visit(cell_index({i, j, k}));
}

std::vector<std::pair<double, int>> ElementHash::near(const Vec3& x, double reach) const {
  std::vector<int> found;
  const Box box(x - Vec3::Constant(reach), x + Vec3::Constant(reach));
  if (!x.allFinite() || bounds_.isEmpty() || !bounds_.intersects(box)) return {};
  for_each_cell(box, [&](int cell) {
    found.insert(found.end(), elements_.begin() + first_[cell], elements_.begin() + first_[cell + 1]);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<std::pair<double, int>> near;
  for (int e : found) {
    const double distance = boxes_[e].exteriorDistance(x);
    if (distance <= reach) near.emplace_back(distance, e);
  }
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace cfem_cutting
