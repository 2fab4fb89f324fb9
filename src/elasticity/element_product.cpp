#include "element_product.h"

#include "node_loops.h"
#include "rotation.h"

namespace cfem_cutting {

SingleField to_quads(const NodeField& field) {
  SingleField quads(4, field.cols());
  quads.topRows<3>() = field.cast<float>();
  quads.row(3).setZero();
  return quads;
}

void to_quads(const NodeField& field, ThreadPool& pool, SingleField& quads) {
  quads.resize(4, field.cols());
  for_each_node(pool, field.cols(), [&](int n) { quads.col(n) << field.col(n).cast<float>(), 0.0f; });
}

NodeField from_quads(const SingleField& field) { return field.topRows<3>().cast<double>(); }

void ElementProduct::arrange(ElementsPointer elements) {
  elements_ = std::move(elements);
  single_.stiffness = PackedStiffness<float>(*elements_);  // every solve needs it, the other hardly any
  single_.stiffness_fits = true;
  double_.stiffness_fits = false;
  diagonal_rotations_.clear();
  rotate(std::vector<Mat3>(elements_->set.size(), Mat3::Identity()));
}

void ElementProduct::rotate(std::vector<Mat3>&& rotations) {
  rotations_.swap(rotations);
  single_.rotations_fit = double_.rotations_fit = false;
}

void ElementProduct::apply(const SingleField& p, SingleField& y) const {
  y.resize(4, p.cols());
  apply(p, [&](int node, const Quad& sum) { y.col(node) = sum; });
}

bool ElementProduct::update_diagonal() {
  fit(single_);
  const bool turned = has_turned();
  if (turned) find_diagonal();
  return turned;
}

bool ElementProduct::has_turned() const {
  if (diagonal_rotations_.size() != single_.rotations.size()) return true;
  constexpr auto kFarthest = static_cast<float>(kDiagonalTurn * kDiagonalTurn / 16.0);  // of parameters
  const float *now = single_.rotations.data(), *then = diagonal_rotations_.data();
  for (std::size_t first = 0; first < diagonal_rotations_.size(); first += 3 * kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = first + lane;
      const float x = now[i] - then[i], y = now[i + kLanes] - then[i + kLanes],
                  z = now[i + 2 * kLanes] - then[i + 2 * kLanes];
      if (x * x + y * y + z * z > kFarthest) return true;
    }
  }
  return false;
}

void ElementProduct::find_diagonal() {
  diagonal_rotations_ = single_.rotations;
  diagonal_.resize(elements_->set.node_count);
  for (const bool beside : {false, true})
    elements_->tiles.sum_up<float>(
        *pool_,
        [&](int b, float* y) { cfem_cutting::find_diagonal(batch<float>(single_, b, nullptr, y), beside); },
        [&](int node, const Quad& sum) {
          (beside ? diagonal_[node].beside() : diagonal_[node].diagonal()) = sum.head<3>();
        });
}

template <typename Scalar>
void ElementProduct::fit(Packed<Scalar>& packed) const {
  if (!packed.stiffness_fits) packed.stiffness = PackedStiffness<Scalar>(*elements_);
  if (!packed.rotations_fit) pack_rotations(packed.rotations);
  packed.stiffness_fits = packed.rotations_fit = true;
}
template void ElementProduct::fit(Packed<float>& packed) const;
template void ElementProduct::fit(Packed<double>& packed) const;

template <typename Scalar>
void ElementProduct::pack_rotations(std::vector<Scalar>& packed) const {
  const ElementTiles& tiles = elements_->tiles;
  packed.resize(static_cast<std::size_t>(tiles.size()) * 3 * kLanes, Scalar{0});
  tiles.for_each(*pool_, [&](int b) {
    const ElementTiles::Batch& batch = tiles.batches[b];
    Scalar* out = packed.data() + static_cast<std::size_t>(b) * 3 * kLanes;
    for (int lane = 0; lane < batch.count; ++lane) {
      const Vec3 parameters = rodrigues_parameters(rotations_[tiles.element_of_lane[batch.first + lane]]);
      for (int i = 0; i < 3; ++i) out[i * kLanes + lane] = static_cast<Scalar>(parameters[i]);
    }
  });
}

}  // namespace cfem_cutting
