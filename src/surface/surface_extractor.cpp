#include "adaptation.h"
#include "cfem_cutting/surface/tissue_surface.h"
#include "mesher.h"

namespace cfem_cutting {

struct SurfaceExtractor::State {
  State(const VoxelVolume& volume, NearestOnCut nearest) : contour(volume), on_cut(std::move(nearest)) {}

  Contour contour;
  NearestOnCut on_cut;
  Mesher mesher;
  FrontTrace trace;
  bool freeze_next = false;
};

namespace {

/// Vertices at the ends of a trace and on detours leave their cells; where that turns a triangle, they stay.
void unfold(Contour& contour, Mesher& mesher) {
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    const std::vector<Anchor> turned = mesher.turned();
    if (turned.empty()) return;
    for (const Anchor& anchor : turned) retract(contour, anchor.cell, anchor.group);
    mesher.place(contour, false);
  }
}

}  // namespace

SurfaceExtractor::SurfaceExtractor(const VoxelVolume& volume, NearestOnCut on_cut)
    : s_(std::make_unique<State>(volume, std::move(on_cut))) {}

SurfaceExtractor::~SurfaceExtractor() = default;

const TissueSurface& SurfaceExtractor::surface() const { return s_->mesher.surface(); }

const TissueSurface& SurfaceExtractor::extract(const FrontTrace& trace, bool adapts) {
  const bool changed = s_->contour.update();
  if (changed || trace != s_->trace) {
    adapt(s_->contour, trace, adapts);
    if (s_->freeze_next && adapts && s_->on_cut) end_on_cut(s_->contour, s_->on_cut);
    if (changed) s_->mesher.build(s_->contour);
    s_->mesher.place(s_->contour, changed);
    unfold(s_->contour, s_->mesher);
    s_->trace = trace;
  }
  if (s_->freeze_next) freeze_cut_ends(s_->contour);
  s_->freeze_next = false;
  return surface();
}

void SurfaceExtractor::freeze() {
  freeze_cut_ends(s_->contour);
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
