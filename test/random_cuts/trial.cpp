#include "trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "cfem_cutting/geometry/self_crossings.h"
#include "link_oracle.h"

namespace cfem_cutting::random_cuts {
namespace {

/// A cut under examination.
class Trial {
 public:
  Trial(std::uint64_t seed, const Options& options)
      : options_(options),
        dice_(seed),
        aim_(dice_.chance(0.5)   ? Aim::kAnywhere
             : dice_.chance(0.5) ? Aim::kOnLattice
                                 : Aim::kNearlyLattice),
        tissue_(random_tissue(dice_, aim_ != Aim::kAnywhere, options.bunny)),
        cutter_(tissue_.volume, dice_.integer(0, 2)) {
    const char* aim[] = {"anywhere", "on the lattice", "nearly on the lattice"};
    outcome_.description = tissue_.name + ", " + aim[static_cast<int>(aim_)];
  }

  Outcome run() {
    const int strokes = options_.kind == Kind::kCrossing ? dice_.integer(2, 3) : 1;
    for (int i = 0; i < strokes; ++i) draw_stroke();
    cutter_.lift();
    check_surface("at the end");
    check_links();
    check_volumes();
    outcome_.links_severed = cutter_.volume().severed_count();
    outcome_.surface = measure(cutter_.surface());
    if (options_.self_crossings) outcome_.surface.crossing = count_self_crossings(cutter_.surface().rest());
    return std::move(outcome_);
  }

 private:
  void draw_stroke() {
    Stroke stroke = random_stroke(dice_, tissue_, aim_);
    const bool stops =
        options_.kind == Kind::kStopped || (options_.kind == Kind::kCrossing && dice_.chance(0.5));
    if (stops) stop(stroke, dice_);
    const int frames = static_cast<int>(stroke.poses.size()) - 1;
    outcome_.description += ", " + std::to_string(frames) + " frames" + (stops ? ", stopped" : "");
    cutter_.draw(stroke, std::max(1, frames / dice_.integer(1, 6)), [&] { check_surface("on the way"); });
  }

  void fail(const std::string& what) { outcome_.failures.push_back(what); }

  void check_surface(const std::string& when) {
    const std::string flaw = find_flaw(cutter_.surface().triangles);
    if (!flaw.empty()) fail("surface " + when + ": " + flaw);
    const SurfaceFigures figures = measure(cutter_.surface());
    if (figures.without_area > 0)
      fail("surface " + when + ": " + std::to_string(figures.without_area) + " triangles without area");
    if (figures.flipped > 0)
      fail("surface " + when + ": " + std::to_string(figures.flipped) + " flipped triangles");
  }

  void check_links() {
    const std::map<LinkId, int> meetings = count_meetings(tissue_.volume, cutter_.sheet());
    std::vector<LinkId> expected;
    for (const auto& [link, times] : meetings) expected.push_back(link);
    const std::vector<LinkId> severed = cutter_.volume().severed_links();
    if (severed != expected)
      fail(std::to_string(severed.size()) + " links severed, " + std::to_string(expected.size()) +
           " expected");
    const int leaks = options_.kind == Kind::kThrough ? count_leaks(tissue_.volume, meetings) : 0;
    if (leaks > 0) fail("the sheet leaks at " + std::to_string(leaks) + " squares of links");
    check_pieces(flood_pieces(tissue_.volume, meetings));
  }

  /// Each expected piece must be one found piece, and of its volume.
  void check_pieces(const std::vector<int>& expected) {
    const Pieces pieces = find_pieces(cutter_.volume());
    std::set<std::pair<int, int>> matches;
    std::map<int, double> volumes;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      matches.emplace(expected[v], pieces.piece_of_voxel[v]);
      volumes[pieces.piece_of_voxel[v]] += tissue_.volume.filled_volume(static_cast<int>(v));
    }
    outcome_.pieces = *std::max_element(expected.begin(), expected.end()) + 1;
    if (matches.size() != static_cast<std::size_t>(outcome_.pieces) || pieces.count() != outcome_.pieces)
      fail(std::to_string(pieces.count()) + " pieces, " + std::to_string(outcome_.pieces) + " expected");
    for (int p = 0; p < pieces.count(); ++p)
      if (!(std::abs(pieces.volumes[p] - volumes[p]) <= 1e-12 * volumes[p])) fail("the volume of a piece");
  }

  void check_volumes() {
    const std::vector<double> volumes = find_pieces(cutter_.volume()).volumes;
    const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0), filled = filled_volume();
    if (!(std::abs(sum - filled) <= 1e-12 * filled)) fail("the pieces' volumes don't add up");
    outcome_.volume_error = std::abs(signed_volume(cutter_.surface()) / filled - 1.0);
    if (!(outcome_.volume_error <= 0.01))
      fail("the surface's volume is off by " + std::to_string(100.0 * outcome_.volume_error) + " %");
  }

  double filled_volume() const {
    double sum = 0.0;
    for (int v = 0; v < static_cast<int>(tissue_.volume.voxels().size()); ++v)
      sum += tissue_.volume.filled_volume(v);
    return sum;
  }

  const Options& options_;
  Dice dice_;
  Aim aim_;
  Tissue tissue_;
  Cutter cutter_;
  Outcome outcome_;
};

}  // namespace

Outcome try_cut(std::uint64_t seed, const Options& options) { return Trial(seed, options).run(); }

}  // namespace cfem_cutting::random_cuts
