#include "packed_stiffness.h"

#include <unordered_map>

#include "mirrored_matrix.h"

namespace cfem_cutting {

template <typename Scalar>
PackedStiffness<Scalar>::PackedStiffness(const TiledElements& elements) {
  const ElementTiles& tiles = elements.tiles;
  std::unordered_map<const ElementMatrix*, int> batch_of_matrix;
  for (int b = 0; b < tiles.size(); ++b) {
    const ElementTiles::Batch& batch = tiles.batches[b];
    const ElementMatrix& K = *elements.set.stiffness[tiles.element_of_lane[batch.first]];
    const auto [known, added] = batch_of_matrix.try_emplace(batch.shared ? &K : nullptr, b);
    if (batch.shared && !added) {
      first_.push_back(first_[known->second]);
      form_.push_back(form_[known->second]);
      continue;
    }
    first_.push_back(entries_.size());
    if (batch.shared) {
      add_whole(K);
    } else {
      add_triangles(elements, batch);
    }
  }
}

/// One matrix for all lanes.
template <typename Scalar>
void PackedStiffness<Scalar>::add_whole(const ElementMatrix& K) {
  const std::optional<MirroredMatrix> blocks = mirrored(K);
  form_.push_back(blocks ? MatrixForm::kMirrored : MatrixForm::kWhole);
  const double* values = blocks ? blocks->data() : K.data();
  for (int i = 0; i < (blocks ? kMirroredMatrix : kWholeMatrix); ++i)
    entries_.push_back(static_cast<Scalar>(values[i]));
}

template <typename Scalar>
void PackedStiffness<Scalar>::add_triangles(const TiledElements& elements, const ElementTiles::Batch& batch) {
  form_.push_back(MatrixForm::kTriangles);
  entries_.resize(entries_.size() + kTriangle * kLanes, Scalar{0});
  Scalar* entry = entries_.data() + first_.back();
  for (int j = 0; j < 24; ++j)
    for (int i = j; i < 24; ++i, entry += kLanes)
      for (int lane = 0; lane < batch.count; ++lane)
        entry[lane] = static_cast<Scalar>(
            (*elements.set.stiffness[elements.tiles.element_of_lane[batch.first + lane]])(i, j));
}

template class PackedStiffness<float>;
template class PackedStiffness<double>;

}  // namespace cfem_cutting
