#include "prolongation.h"

#include <algorithm>
#include <cassert>

namespace cfem_cutting {
namespace {

/// Rows with kTerms terms each.
/// @return the term after the last
template <int kTerms>
const int* add_rows(const int* row, const int* end, const int* term, const Eigen::Matrix4Xf& x,
                    Eigen::Matrix4Xf& y) {
  for (; row != end; ++row, term += kTerms) {
    Eigen::Vector4f sum = x.col(term[0]);
    for (int t = 1; t < kTerms; ++t) sum += x.col(term[t]);
    y.col(*row) += (1.0f / kTerms) * sum;
  }
  return term;
}

}  // namespace

Prolongation::Prolongation(const Interpolation& interpolation) {
  constexpr int kPart = 256;
  for (int begin = 0; begin < interpolation.rows(); begin += kPart) {
    const int end = std::min(begin + kPart, interpolation.rows());
    Part part;
    part.term = static_cast<int>(terms_.size());
    for (int halvings = 0; halvings < 4; ++halvings) {
      part.row[halvings] = static_cast<int>(rows_.size());
      for (int i = begin; i < end; ++i) {
        const Interpolation::Row row = interpolation.row(i);
        if (row.last - row.first != 1 << halvings) continue;
        assert(static_cast<int>(row.first->halvings) == halvings);
        rows_.push_back(i);
        for (const Interpolation::Term& term : row) terms_.push_back(static_cast<int>(term.node));
      }
    }
    part.row[4] = static_cast<int>(rows_.size());
    parts_.push_back(part);
  }
}

void Prolongation::add(ThreadPool& pool, const Eigen::Matrix4Xf& x, Eigen::Matrix4Xf& y) const {
  constexpr int kFewest = 2;  // parts worth waking a thread for
  pool.for_range(static_cast<int>(parts_.size()), kFewest, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const auto row = [&](int i) { return rows_.data() + parts_[p].row[i]; };
      const int* term = terms_.data() + parts_[p].term;
      term = add_rows<1>(row(0), row(1), term, x, y);
      term = add_rows<2>(row(1), row(2), term, x, y);
      term = add_rows<4>(row(2), row(3), term, x, y);
      add_rows<8>(row(3), row(4), term, x, y);
    }
  });
}

}  // namespace cfem_cutting
