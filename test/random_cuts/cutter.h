#pragma once

#include <memory>

#include "cfem_cutting/cutting/crossings.h"
#include "cfem_cutting/simulation/front_tracker.h"
#include "cfem_cutting/surface/tissue_surface.h"
#include "stroke.h"

namespace cfem_cutting::random_cuts {

/// The swept surface without anything left out, in material space.
using Sheet = std::vector<SweptTriangle>;

/// Cuts undeformed tissue as the simulation does in immediate mode.
class Cutter {
 public:
  Cutter(const VoxelVolume& volume, int composite_level);

  /// Sets the blade down at the stroke's first pose and moves it along the others; severs what it met, and
  /// makes the surface anew, after each `frames_per_step` poses.
  /// @param look called after each step
  template <typename Look>
  void draw(const Stroke& stroke, int frames_per_step, Look look) {
    set_down(stroke);
    const int frames = static_cast<int>(stroke.poses.size());
    for (int i = 1; i < frames; ++i) {
      move(stroke.poses[i]);
      if (i % frames_per_step != 0 && i + 1 != frames) continue;
      sever();
      look();
    }
  }

  /// Takes the blade away.
  void lift();

  const VoxelVolume& volume() const { return volume_; }
  const TissueSurface& surface() const { return extractor_.surface(); }
  const Sheet& sheet() const { return sheet_; }  ///< of all strokes

 private:
  void set_down(const Stroke& stroke);
  void move(const Pose& X_TB);
  void record(const FrontMotion& motion, const Polyline& before, const Polyline& after);
  void sever();
  void refresh_reference();

  VoxelVolume volume_;
  int level_;
  std::unique_ptr<CompositeMesh> mesh_;
  std::unique_ptr<InverseMap> pull_back_;
  std::unique_ptr<FrontTracker> tracker_;
  SurfaceExtractor extractor_;
  std::vector<Crossing> candidates_;
  Sheet sheet_;
};

}  // namespace cfem_cutting::random_cuts
