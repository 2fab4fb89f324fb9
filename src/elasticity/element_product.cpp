#include "element_product.h"

namespace cfem_cutting {
namespace {

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
  batches_ = ElementBatches(elements_);
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

template <typename Scalar>
void ElementProduct::pack_stiffness(Packed<Scalar>& packed) const {
  packed.stiffness_fits = true;
  packed.stiffness_of_batch.clear();
  std::size_t size = 0;
  const ElementMatrix* last = nullptr;
  for (const ElementBatches::Batch& batch : batches_.batches) {
    const ElementMatrix* matrix = elements_.stiffness[batches_.element_of_lane[batch.first]].get();
    const bool again = batch.shared && matrix == last;
    packed.stiffness_of_batch.push_back(again ? packed.stiffness_of_batch.back() : size);
    if (!again) size += batch.shared ? kWholeMatrix : kTriangle * kLanes;
    last = matrix;
  }
  packed.stiffness.assign(size, Scalar{0});
  for (int b = 0; b < batches_.size(); ++b) {
    const ElementBatches::Batch& batch = batches_.batches[b];
    Scalar* out = packed.stiffness.data() + packed.stiffness_of_batch[b];
    for (int lane = 0; lane < (batch.shared ? 1 : batch.count); ++lane)
      pack_matrix(*elements_.stiffness[batches_.element_of_lane[batch.first + lane]], batch.shared,
                  out + lane);
  }
  packed.products.resize(static_cast<std::size_t>(batches_.size()) * ElementBatches::kEntries);
  packed.rotations.assign(static_cast<std::size_t>(batches_.size()) * 9 * kLanes, Scalar{0});
}

template <typename Scalar>
void ElementProduct::pack_rotations(Packed<Scalar>& packed) const {
  packed.rotations_fit = true;
  batches_.for_each(*pool_, [&](int b) {
    const ElementBatches::Batch& batch = batches_.batches[b];
    Scalar* out = packed.rotations.data() + static_cast<std::size_t>(b) * 9 * kLanes;
    for (int lane = 0; lane < batch.count; ++lane) {
      const Mat3& R = rotations_[batches_.element_of_lane[batch.first + lane]];
      for (int i = 0; i < 9; ++i) out[i * kLanes + lane] = static_cast<Scalar>(R(i / 3, i % 3));
    }
  });
}

template <typename Scalar>
void ElementProduct::multiply_all(const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& p,
                                  Eigen::Matrix<Scalar, 3, Eigen::Dynamic>& y, Packed<Scalar>& packed) const {
  if (!packed.stiffness_fits) pack_stiffness(packed);
  if (!packed.rotations_fit) pack_rotations(packed);
  batches_.for_each(*pool_, [&](int b) {
    multiply({packed.stiffness.data() + packed.stiffness_of_batch[b], batches_.batches[b].shared,
              packed.rotations.data() + static_cast<std::size_t>(b) * 9 * kLanes, batches_.nodes_of(b),
              p.data(), packed.products.data() + static_cast<std::size_t>(b) * ElementBatches::kEntries});
  });
  batches_.add_up(*pool_, packed.products, y);
}

}  // namespace cfem_cutting
