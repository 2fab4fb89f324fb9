#pragma once

#include "element_tiles.h"

namespace cfem_cutting {

/// The matrices of elements as kernels take them.
template <typename Scalar>
class PackedStiffness {
 public:
  PackedStiffness() = default;
  explicit PackedStiffness(const TiledElements& elements);

  MatrixForm form(int batch) const { return form_[batch]; }
  const Scalar* of_batch(int batch) const { return entries_.data() + first_[batch]; }

 private:
  void add_whole(const ElementMatrix& K);
  void add_own(const TiledElements& elements, const ElementTiles::Batch& batch);

  std::vector<Scalar> entries_;
  std::vector<std::size_t> first_;  // per batch; matrices that several batches share are there once
  std::vector<MatrixForm> form_;
};

}  // namespace cfem_cutting
