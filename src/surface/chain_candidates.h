#pragma once

#include <array>
#include <set>
#include <vector>

#include "front_chain.h"
#include "front_walk.h"
#include "polygon.h"

namespace cfem_cutting {

/// Vertices of the surface that may become part of a chain along a trace, ascending along it.
class ChainCandidates {
 public:
  struct Candidate {
    int cell = -1, group = -1;
    int piece = 0;          ///< of the walk, the nearest
    Vec3 X = Vec3::Zero();  ///< m, on the trace
    double along = 0.0;     ///< m, on the trace
    double cost = 0.0;      ///< voxel edges of stretch
  };

  /// @param avoided diagonals that do not join
  ChainCandidates(const Contour& contour, const Trace& trace, const std::set<Diagonal>& avoided);

  int size() const { return static_cast<int>(candidates_.size()); }
  const Candidate& operator[](int i) const { return candidates_[i]; }
  const std::vector<int>& joined_before(int i) const { return joined_[i]; }  ///< those that an edge leads to
  double length() const { return from_.back(); }                             ///< m, of the trace
  int piece_count() const { return static_cast<int>(walk_.size()); }

  /// Voxels, lengths of the walk's pieces [first, last) that could have had a vertex.
  double left_out(int first, int last) const;

 private:
  void add_on_walk();
  void add_in(const DualCell& cell, int c, std::size_t piece);
  void add_beside();
  Candidate make(int cell, int group, std::size_t piece, const Vec3& X, double cost) const;
  void join(const std::set<Diagonal>& avoided);
  bool is_in_slit(const Polygon& polygon, int i) const;
  std::set<LinkSide> sides() const;

  const Contour& contour_;
  double h_;  // m, a voxel's edge
  std::vector<FrontPiece> walk_;
  std::vector<double> from_;  // m, along the trace, where each piece begins; and the end
  std::vector<bool> passable_;
  std::set<std::array<int, 3>> on_walk_;  // cells
  std::vector<Candidate> candidates_;
  std::vector<std::vector<int>> joined_;
};

}  // namespace cfem_cutting
