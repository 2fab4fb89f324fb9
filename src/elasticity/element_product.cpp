#include "element_product.h"

#include <algorithm>
#include <unordered_map>

#include "element_kernel.h"

namespace cfem_cutting {
namespace {

constexpr int kEntries = 24 * kLanes;      // of a batch in Packed::products
constexpr int kElementsPerThread = 2048;   // fewer are not worth waking a thread
constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElementSet& elements) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const ElementMatrix*, std::size_t> group_of_matrix;
  for (int e = 0; e < elements.size(); ++e) {
    const auto [it, added] = group_of_matrix.try_emplace(elements.stiffness[e].get(), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

/// The kernel's form of a matrix: whole, column by column, if shared by the lanes; else its lower triangle.
template <typename Scalar>
void pack_matrix(const ElementMatrix& K, bool shared, Scalar* out) {
  for (int j = 0; j < 24; ++j) {
    for (int i = shared ? 0 : j; i < 24; ++i) {
      *out = static_cast<Scalar>(K(i, j));
      out += shared ? 1 : kLanes;
    }
  }
}

}  // namespace

void ElementProduct::arrange(ElementSet elements) {
  elements_ = std::move(elements);
  batches_.clear();
  element_of_lane_.clear();
  stiffness_count_ = 0;
  std::vector<int> others;
  for (const std::vector<int>& group : group_by_matrix(elements_)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add_batches(group, true);
    } else {
      others.insert(others.end(), group.begin(), group.end());
    }
  }
  std::sort(others.begin(), others.end());
  add_batches(others, false);
  connect_nodes();
  single_.stiffness_fits = double_.stiffness_fits = false;
  rotate(std::vector<Mat3>(elements_.size(), Mat3::Identity()));
}

void ElementProduct::rotate(std::vector<Mat3> rotations) {
  rotations_ = std::move(rotations);
  single_.rotations_fit = double_.rotations_fit = false;
}

void ElementProduct::apply(const SingleField& p, SingleField& y) const { multiply_all(p, y, single_); }

void ElementProduct::apply(const NodeField& p, NodeField& y) const { multiply_all(p, y, double_); }

std::vector<Mat3> ElementProduct::diagonal_at_rest() const {
  std::vector<Mat3> blocks(elements_.node_count, Mat3::Zero());
  for (int e = 0; e < elements_.size(); ++e)
    for (int n = 0; n < 8; ++n)
      blocks[elements_.nodes[e][n]] += elements_.stiffness[e]->block<3, 3>(3 * n, 3 * n);
  return blocks;
}

void ElementProduct::add_batches(const std::vector<int>& elements, bool shared) {
  const std::size_t matrix = stiffness_count_;
  if (shared) stiffness_count_ += kWholeMatrix;
  for (std::size_t first = 0; first < elements.size(); first += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, elements.size() - first));
    batches_.push_back(
        {static_cast<int>(element_of_lane_.size()), count, shared, shared ? matrix : stiffness_count_});
    if (!shared) stiffness_count_ += kTriangle * kLanes;
    element_of_lane_.insert(element_of_lane_.end(), elements.begin() + first,
                            elements.begin() + first + count);
  }
}

void ElementProduct::connect_nodes() {
  nodes_.assign(batches_.size() * 8 * kLanes, 0);
  std::vector<int> base_of_element(elements_.size());
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    for (int lane = 0; lane < batches_[b].count; ++lane) {
      const int e = element_of_lane_[batches_[b].first + lane];
      base_of_element[e] = static_cast<int>(b) * kEntries + lane;
      for (int n = 0; n < 8; ++n) nodes_[(b * 8 + n) * kLanes + lane] = elements_.nodes[e][n];
    }
  }
  NodeCorners at(elements_);
  first_slot_ = std::move(at.first);
  element_corner_of_slot_ = std::move(at.corners);
  slots_.resize(element_corner_of_slot_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const int corner = element_corner_of_slot_[s];
    slots_[s] = base_of_element[corner / 8] + 3 * (corner % 8) * kLanes;
  }
}

template <typename Scalar>
void ElementProduct::pack_stiffness(Packed<Scalar>& packed) const {
  packed.stiffness_fits = true;
  packed.stiffness.assign(stiffness_count_, Scalar{0});
  for (const Batch& batch : batches_) {
    Scalar* out = packed.stiffness.data() + batch.stiffness;
    const int lanes = batch.shared ? 1 : batch.count;
    for (int lane = 0; lane < lanes; ++lane)
      pack_matrix(*elements_.stiffness[element_of_lane_[batch.first + lane]], batch.shared, out + lane);
  }
  packed.products.resize(batches_.size() * kEntries);
  packed.rotations.assign(batches_.size() * 9 * kLanes, Scalar{0});
}

template <typename Scalar>
void ElementProduct::pack_rotations(Packed<Scalar>& packed) const {
  packed.rotations_fit = true;
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    for (int lane = 0; lane < batches_[b].count; ++lane) {
      const Mat3& R = rotations_[element_of_lane_[batches_[b].first + lane]];
      for (int i = 0; i < 9; ++i)
        packed.rotations[(b * 9 + i) * kLanes + lane] = static_cast<Scalar>(R(i / 3, i % 3));
    }
  }
}

template <typename Scalar>
void ElementProduct::multiply_all(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& p,
                                  Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& y, Packed<Scalar>& packed) const {
  if (!packed.stiffness_fits) pack_stiffness(packed);
  if (!packed.rotations_fit) pack_rotations(packed);
  pool_->for_range(static_cast<int>(batches_.size()), kElementsPerThread / kLanes, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      multiply({packed.stiffness.data() + batches_[b].stiffness, batches_[b].shared,
                packed.rotations.data() + std::size_t(b) * 9 * kLanes,
                nodes_.data() + std::size_t(b) * 8 * kLanes, p.data(),
                packed.products.data() + std::size_t(b) * kEntries});
    }
  });
  y.resize(3, p.cols());
  pool_->for_range(static_cast<int>(p.cols()), kElementsPerThread, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      Eigen::Matrix<Scalar, 3, 1> sum = Eigen::Matrix<Scalar, 3, 1>::Zero();
      for (int s = first_slot_[node]; s < first_slot_[node + 1]; ++s) {
        const Scalar* entry = packed.products.data() + slots_[s];
        sum += Eigen::Matrix<Scalar, 3, 1>(entry[0], entry[kLanes], entry[2 * kLanes]);
      }
      y.col(node) = sum;
    }
  });
}

}  // namespace cfem_cutting
