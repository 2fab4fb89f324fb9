#include "packed_stiffness.h"

#include <algorithm>
#include <unordered_map>

#include "mirrored_matrix.h"

namespace cfem_cutting {
namespace {

/// Writes entries of one lane.
template <typename Scalar>
struct LaneWriter {
  Scalar* place;
  void add(double value) {
    *place = static_cast<Scalar>(value);
    place += kLanes;
  }
  /// The lower triangle of a matrix, column by column.
  template <typename Matrix>
  void add_triangle(const Matrix& matrix) {
    for (int j = 0; j < matrix.cols(); ++j)
      for (int i = j; i < matrix.rows(); ++i) add(matrix(i, j));
  }
};

}  // namespace

template <typename Scalar>
PackedStiffness<Scalar>::PackedStiffness(const TiledElements& elements) {
  const ElementTiles& tiles = elements.tiles;
  const auto own = std::count_if(tiles.batches.begin(), tiles.batches.end(),
                                 [](const ElementTiles::Batch& batch) { return !batch.shared; });
  entries_.reserve(static_cast<std::size_t>(own) * kTriangle * kLanes);  // mostly less
  std::unordered_map<const RestMatrix*, int> batch_of_matrix;
  for (int b = 0; b < tiles.size(); ++b) {
    const ElementTiles::Batch& batch = tiles.batches[b];
    const RestMatrix& K = *elements.set.stiffness[tiles.element_of_lane[batch.first]];
    const auto [known, added] = batch_of_matrix.try_emplace(batch.shared ? &K : nullptr, b);
    if (batch.shared && !added) {
      first_.push_back(first_[known->second]);
      form_.push_back(form_[known->second]);
      continue;
    }
    first_.push_back(entries_.size());
    if (batch.shared) {
      add_whole(K.whole);
    } else {
      add_own(elements, batch);
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

/// One matrix a lane.
template <typename Scalar>
void PackedStiffness<Scalar>::add_own(const TiledElements& elements, const ElementTiles::Batch& batch) {
  const auto matrix_of = [&](int lane) -> const RestMatrix& {
    return *elements.set.stiffness[elements.tiles.element_of_lane[batch.first + lane]];
  };
  const bool deforms = matrix_of(0).deformations.has_value();
  form_.push_back(deforms ? MatrixForm::kDeformations : MatrixForm::kTriangles);
  entries_.resize(entries_.size() + (deforms ? kDeformationMatrix : kTriangle) * kLanes, Scalar{0});
  for (int lane = 0; lane < batch.count; ++lane) {
    LaneWriter<Scalar> out{entries_.data() + first_.back() + lane};
    const RestMatrix& K = matrix_of(lane);
    if (!deforms) {
      out.add_triangle(K.whole);
      continue;
    }
    for (double ratio : K.deformations->ratio) out.add(ratio);
    out.add_triangle(K.deformations->among_kept);
    for (int n = 0; n < 8; ++n) out.add_triangle(K.whole.block<3, 3>(3 * n, 3 * n));
  }
}

template class PackedStiffness<float>;
template class PackedStiffness<double>;

}  // namespace cfem_cutting
