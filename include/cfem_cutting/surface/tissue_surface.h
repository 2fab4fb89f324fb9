#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"
#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/geometry/triangle_mesh.h"

namespace cfem_cutting {

/// A vertex of the tissue's surface. It follows the element of its voxel.
struct SurfaceVertex {
  Vec3 X;      ///< m, material position
  int voxel;   ///< a linked voxel of the component in its dual cell
  Vec3i cell;  ///< dual cell: the cube between the centres of voxels cell … cell + (1, 1, 1)
  bool on_front =
      false;  ///< a virtual intersection point holds it: drawn exactly on the blade's edge while bound
};

/// Surface of a voxel volume in material space.
struct TissueSurface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::uint8_t> cut;              ///< per triangle: 1 cut face, 0 skin
  std::vector<std::uint8_t> label;            ///< per triangle: of the voxel that it bounds
  TriangleMesh rest() const;                  ///< the surface in material space
};

/// Virtual intersection points: positions that the influence domain adaptation puts in place of the error
/// function's minimum, by the curve of material points (the trace of the front on the skin, or the cut's end)
/// that runs through the dual cells. Pieces of the curve where the edge is out of tissue are separate
/// polylines.
using FrontTrace = std::vector<Polyline>;

/// Manifold dual contouring (after Ju et al. 2002; Schaefer, Ju and Warren 2007).
class SurfaceExtractor {
 public:
  /// @param volume must outlive the extractor
  explicit SurfaceExtractor(const VoxelVolume& volume);
  ~SurfaceExtractor();

  /// Contours again around links severed since the last call, and puts the vertices of the cells that the
  /// trace runs through on it (projected along the shortest way). An empty trace: no adaptation. Cut ends
  /// that were put on an earlier trace by `freeze` stay there.
  const TissueSurface& extract(const FrontTrace& trace);

  /// Keeps the present virtual intersection points of sheets in which a cut ends when the front moves on, and
  /// those that the next `extract` makes: a cut ends where the blade was, until the cut goes on through the
  /// same sheets.
  void freeze();

  const TissueSurface& surface() const;

  /// Whether the dual cell of a material point holds skin or a cut's end: what the adaptation can place
  /// there. (A blade in uncut tissue, or in a stab that is narrower than a voxel, has no surface around it.)
  bool reaches(const Vec3& X) const;

 private:
  struct State;
  std::unique_ptr<State> s_;
};

/// A surface placed by node positions, with smooth normals on the skin and separate ones on both sides of the
/// rim.
struct DeformedSurface {
  std::vector<Vec3> positions;  ///< m, (|V|)
  std::vector<int> source;      ///< index of the TissueSurface vertex that each stems from, (|V|)
  std::vector<Vec3> normals;    ///< unit, (|V|)
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::uint8_t> cut;    ///< per triangle: 1 cut face, 0 skin
  std::vector<std::uint8_t> label;  ///< per triangle: of the voxel that it bounds
  TriangleMesh mesh() const { return {positions, triangles}; }
};

/// Vertices shared by skin and cut triangles are doubled so that the rim is sharp (triangle indices refer to
/// the doubled vertices; `source` of each: first the surface's vertices, then the doubles).
/// @param front where bound vertices (on_front) are drawn; empty: leave them
DeformedSurface deform(const TissueSurface& surface, const CompositeMesh& mesh, const NodeField& x,
                       const Polyline& front);

/// Figures about a surface.
struct SurfaceQuality {
  MeshDefects defects;
  double volume = 0.0;  ///< m³
  int degenerate = 0;   ///< triangles of no area
  int needles = 0;      ///< triangles with an angle under 5°
};
SurfaceQuality assess(const TriangleMesh& mesh);

}  // namespace cfem_cutting
