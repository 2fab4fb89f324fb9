#include "adaptation.h"
#include "cfem_cutting/surface/tissue_surface.h"
#include "front_walk.h"
#include "mesher.h"

namespace cfem_cutting {

struct SurfaceExtractor::State {
  explicit State(const VoxelVolume& volume) : contour(volume) {}

  Contour contour;
  Mesher mesher;
  FrontTrace trace;
  bool freeze_next = false;
};

SurfaceExtractor::SurfaceExtractor(const VoxelVolume& volume) : s_(std::make_unique<State>(volume)) {}

SurfaceExtractor::~SurfaceExtractor() = default;

const TissueSurface& SurfaceExtractor::surface() const { return s_->mesher.surface(); }

const TissueSurface& SurfaceExtractor::extract(const FrontTrace& trace) {
  const bool changed = s_->contour.update();
  if (changed || trace != s_->trace) {
    adapt(s_->contour, trace);
    if (changed) s_->mesher.build(s_->contour);
    s_->mesher.place(s_->contour, changed);
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

bool SurfaceExtractor::reaches(const Vec3& X) const {
  const int cell = s_->contour.find(dual_cell_at(s_->contour.volume().lattice(), X));
  return cell >= 0 && holds_crease(s_->contour.cells()[cell]);
}

TriangleMesh TissueSurface::rest() const {
  TriangleMesh mesh;
  mesh.vertices.reserve(vertices.size());
  for (const SurfaceVertex& vertex : vertices) mesh.vertices.push_back(vertex.X);
  mesh.triangles = triangles;
  return mesh;
}

}  // namespace cfem_cutting
