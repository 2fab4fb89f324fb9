#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cfem_cutting/elasticity/composite_mesh.h"
#include "cfem_cutting/geometry/polyline.h"
#include "cfem_cutting/geometry/triangle_mesh.h"

namespace cfem_cutting {

/// Ends of the blade's edge that can lie in tissue.
enum class EdgeEnd : std::uint8_t { kNone, kHeel, kTip };

/// A vertex of the tissue's surface. It follows the element of its voxel.
struct SurfaceVertex {
  Vec3 X;      ///< m, material position
  int voxel;   ///< whose element it follows: of its component in the dual cell, or at X on a crease or cut's
               ///< end
  Vec3i cell;  ///< dual cell: the cube between the centres of voxels cell … cell + (1, 1, 1)
  bool on_front =
      false;             ///< the front passes its cell: with adaptation it lies on the trace, and on the edge
  bool cut_end = false;  ///< a cut ends in its sheet
  EdgeEnd edge_end = EdgeEnd::kNone;  ///< the edge ends here
};

/// Surface of a voxel volume in material space.
struct TissueSurface {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::uint8_t> cut;              ///< per triangle: 1 cut face, 0 skin
  std::vector<std::uint8_t> label;            ///< per triangle: of the voxel that it bounds
  TriangleMesh rest() const;                  ///< the surface in material space
};

/// A curve of material points, m, on which the surface meets the edge: the trace of the front on the skin, or
/// the cut's end; from heel to tip.
struct Trace {
  Trace() = default;
  Trace(Polyline points_in) : points(std::move(points_in)) {}
  bool operator==(const Trace& other) const {
    return points == other.points && heel == other.heel && tip == other.tip;
  }
  Polyline points;
  bool heel = false;  ///< it begins at the edge's heel
  bool tip = false;   ///< it ends at the edge's tip
};

/// Virtual intersection points: positions that the influence domain adaptation puts in place of the error
/// function's minimum, by the traces that run through the dual cells. One for each part of the edge in
/// tissue.
using FrontTrace = std::vector<Trace>;

/// Manifold dual contouring (after Ju et al. 2002; Schaefer, Ju and Warren 2007).
class SurfaceExtractor {
 public:
  /// A point's nearest one on what the blade has cut, m; nothing if that is farther than a voxel.
  using NearestOnCut = std::function<std::optional<Vec3>(const Vec3&)>;

  /// @param volume must outlive the extractor
  /// @param on_cut where vertices at cuts go when links are severed or `freeze` was called; empty: anywhere
  /// in their cells
  explicit SurfaceExtractor(const VoxelVolume& volume, NearestOnCut on_cut = {});
  ~SurfaceExtractor();

  /// Contours again around links severed since the last call, and puts the vertices of the cells that the
  /// trace runs through on it (projected along the shortest way). Cut ends that were put on an earlier trace
  /// by `freeze` stay there.
  /// @param adapts false: the vertices are only marked, and stay where dual contouring has them
  const TissueSurface& extract(const FrontTrace& trace, bool adapts = true);

  /// Keeps the present virtual intersection points of sheets in which a cut ends when the front moves on, and
  /// those that the next `extract` makes: a cut ends where the blade was, until the cut goes on through the
  /// same sheets. With adaptation and `on_cut`, those on the skin and the other vertices at cuts go to what
  /// the blade has cut within a voxel then, and there to the skin, where a cell has no other cut.
  void freeze();

  const TissueSurface& surface() const;

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
/// @param front where bound vertices (on_front) are drawn; empty: leave them. Those within two voxels of a
/// cut's end that it holds are drawn along, the less the farther.
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

/// Triangles, undeformed, whose corners lie in three cells around one link and that turn about it other than
/// the cells do.
int count_flipped(const TissueSurface& surface);

}  // namespace cfem_cutting
