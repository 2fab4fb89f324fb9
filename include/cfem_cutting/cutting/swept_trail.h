#pragma once

#include <algorithm>

#include "cfem_cutting/cutting/sweep.h"

namespace cfem_cutting {

/// The surface that the front sweeps, in rows about a grain apart however many poses come: what the area of a
/// cut is measured on. (Links are crossed by every motion, not by this.)
class SweptTrail {
 public:
  /// @param grain m, way of the front's points from row to row
  explicit SweptTrail(double grain) : grain_(grain) {}

  /// The front moves on. Rows end also where points of it enter or leave tissue.
  void follow(const MaterialFront& before, const MaterialFront& after);

  /// Takes the surface up to where the front is now, and goes on from there.
  std::vector<SweptTriangle> take();

  /// Forgets triangles for which `is_left` is true.
  template <typename Predicate>
  void drop_if(Predicate is_left) {
    triangles_.erase(std::remove_if(triangles_.begin(), triangles_.end(), is_left), triangles_.end());
  }

  /// Takes back what is not cut yet.
  void give_back(const std::vector<SweptTriangle>& uncut);

  /// Forgets the surface and where the front was.
  void drop();

 private:
  void end_row(const MaterialFront& at);

  double grain_;
  MaterialFront row_;   // the last row
  MaterialFront last_;  // the front now
  std::vector<SweptTriangle> triangles_;
};

}  // namespace cfem_cutting
