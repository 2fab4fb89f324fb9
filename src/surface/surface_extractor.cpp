#include <algorithm>
#include <numeric>

#include "adaptation.h"
#include "cfem_cutting/surface/tissue_surface.h"
#include "mesher.h"
#include "settling.h"

namespace cfem_cutting {

struct SurfaceExtractor::State {
  State(const VoxelVolume& volume, NearestOnCut nearest) : contour(volume), on_cut(std::move(nearest)) {}

  Contour contour;
  NearestOnCut on_cut;
  Mesher mesher;
  FrontTrace trace;
  std::vector<int> following;  // cells that have to do with the trace
  bool freeze_next = false;

  void follow(const FrontTrace& next, bool adapts, bool all);
  void keep_following(std::vector<int>&& cells);
};

namespace {

/// Whose turn it is to be drawn back: into their cells those beside the trace, then those on it; off the cut
/// last.
int turn_of(const SheetGroup& group) { return group.adapted ? 1 : group.times_drawn_back < 2 ? 0 : 2; }

/// Vertices at the ends of a trace, on detours and on the cut leave their cells; where that turns a triangle,
/// they go back.
/// @param cells whose vertices may have moved; those with vertices that go back are added
void unfold(Contour& contour, Mesher& mesher, const SurfaceExtractor::NearestOnCut& on_cut,
            std::vector<int>& cells) {
  constexpr int kTries = 20;
  std::vector<int> near = cells;
  for (int i = 0; i < kTries; ++i) {
    std::vector<int> drawn_back;
    const std::vector<Anchor> turned = mesher.turned(near);
    near.clear();
    for (const Anchor& anchor : turned) near.push_back(anchor.cell);
    for (int turn = 0; turn < 3 && drawn_back.empty(); ++turn)
      for (const Anchor& anchor : turned)
        if (turn_of(contour.cells()[anchor.cell].groups[anchor.group]) == turn &&
            draw_back(contour, anchor.cell, anchor.group, on_cut))
          drawn_back.push_back(anchor.cell);
    if (drawn_back.empty()) return;
    mesher.place(contour, drawn_back);
    cells.insert(cells.end(), drawn_back.begin(), drawn_back.end());
  }
}

}  // namespace

SurfaceExtractor::SurfaceExtractor(const VoxelVolume& volume, NearestOnCut on_cut)
    : s_(std::make_unique<State>(volume, std::move(on_cut))) {}

SurfaceExtractor::~SurfaceExtractor() = default;

const TissueSurface& SurfaceExtractor::surface() const { return s_->mesher.surface(); }

/// Where quads can't have their diagonals along the chain, it takes another way.
void SurfaceExtractor::State::follow(const FrontTrace& next, bool adapts, bool all) {
  constexpr int kTries = 3;
  const bool settles = (all || freeze_next) && adapts && on_cut;
  if (settles) settle_midpoints(contour, mesher, on_cut);
  std::vector<int> cells = following;
  if (all || settles) {
    cells.resize(contour.cells().size());
    std::iota(cells.begin(), cells.end(), 0);
  }
  std::set<Diagonal> avoided;
  for (int i = 0; i < kTries; ++i) {
    adapt(contour, next, adapts, avoided, cells);
    if (settles) settle_on_cut(contour, on_cut);
    mesher.place(contour, cells);
    unfold(contour, mesher, on_cut, cells);
    const auto missed = mesher.missed_diagonals(cells);
    if (missed.empty()) break;
    for (const auto& [a, b] : missed) avoided.insert(diagonal_between({a.cell, a.group}, {b.cell, b.group}));
  }
  trace = next;
  keep_following(std::move(cells));
}

void SurfaceExtractor::State::keep_following(std::vector<int>&& cells) {
  std::sort(cells.begin(), cells.end());
  const auto is_left = [&](int cell) { return !follows_trace(contour.cells()[cell]); };
  cells.erase(std::remove_if(cells.begin(), std::unique(cells.begin(), cells.end()), is_left), cells.end());
  following = std::move(cells);
}

const TissueSurface& SurfaceExtractor::extract(const FrontTrace& trace, bool adapts) {
  const bool changed = s_->contour.update();
  if (changed) s_->mesher.build(s_->contour);
  if (changed || s_->freeze_next || trace != s_->trace) s_->follow(trace, adapts, changed);
  if (s_->freeze_next) freeze_cut_ends(s_->contour, !s_->on_cut);
  s_->freeze_next = false;
  return surface();
}

void SurfaceExtractor::freeze() {
  freeze_cut_ends(s_->contour, !s_->on_cut);
  s_->freeze_next = true;
}

TriangleMesh TissueSurface::rest() const {
  TriangleMesh mesh;
  mesh.vertices.reserve(vertices.size());
  for (const SurfaceVertex& vertex : vertices) mesh.vertices.push_back(vertex.X);
  mesh.triangles = triangles;
  return mesh;
}

}  // namespace cfem_cutting
