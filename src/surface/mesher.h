#pragma once

#include <unordered_map>

#include "cfem_cutting/surface/tissue_surface.h"
#include "diagonals.h"
#include "mesh_parts.h"
#include "polygon.h"

namespace cfem_cutting {

/// What a vertex' place follows.
struct Anchor {
  int cell, group;
  int voxel;  ///< of its sheet
};

/// Joins the sheets' vertices to triangles: a polygon for each link side.
class Mesher {
 public:
  /// Vertices and triangles anew.
  void build(const Contour& contour);

  /// Places the vertices of cells and all midpoints, and splits quads again whose corners moved, or the skin
  /// beside them.
  void place(const Contour& contour, const std::vector<int>& cells);

  /// A vertex of its own in a cell's face, for one of several arcs there between the same two sheets.
  struct Midpoint {
    int vertex;
    Vec3 X;           ///< m, its place but where a chain passes it
    int cell, group;  ///< of the sheet on one side
    int next_cell, next_group;
    int normal_axis;  ///< of the face
    bool at_cut;      ///< an end of the arc is at a severed link
  };
  const std::vector<Midpoint>& midpoints() const { return midpoints_; }

  /// It goes there in the next `place`.
  void move(int midpoint, const Vec3& X) { midpoints_[midpoint].X = X; }

  /// The vertices with virtual intersection points of fans' triangles that are turned or flat about their
  /// link, and of quads with such triangles, at cells' vertices: each once.
  std::vector<Anchor> turned(const std::vector<int>& cells) const;

  /// Those at cells' vertices that the chain takes but the quads can't.
  std::vector<std::pair<Anchor, Anchor>> missed_diagonals(const std::vector<int>& cells) const;

  const TissueSurface& surface() const { return surface_; }

 private:
  void add_polygon(const Contour& contour, const Polygon& polygon);
  void add_fan(const Contour& contour, const Polygon& polygon, const std::vector<int>& rim);
  void add_quad(const Contour& contour, const Polygon& polygon, const std::vector<int>& corners);
  int sheet_vertex(const Contour& contour, int cell, int sheet);
  int midpoint(const Contour& contour, const Polygon& polygon, int i);
  int add_fixed_vertex(const Vec3& X, int voxel, const Vec3i& cell);
  void add_triangle(const Contour& contour, const Polygon& polygon, int a, int b, int c);
  static int voxel_of(const Contour& contour, const Anchor& anchor);
  std::vector<int> parts_at(const std::vector<int>& cells) const;
  bool move(const Contour& contour, int vertex);
  bool move(const Contour& contour, const Midpoint& midpoint);
  bool is_turned(int triangle) const;
  bool is_cut(int part) const { return surface_.cut[parts_.triangles(part).first]; }
  void split_around(const std::vector<int>& moved);
  void split(int part);
  void write(const LinkQuad& quad, bool second_diagonal);
  Diagonals diagonals() const { return {surface_, parts_, chain_}; }

  TissueSurface surface_;
  std::vector<int> direction_;  // per triangle: of its link
  MeshParts parts_;
  mutable std::vector<char> part_is_taken_;          // all 0 between calls
  std::vector<Anchor> anchors_;                      // per vertex; fixed ones have cell −1
  std::vector<int> chain_;                           // per vertex: SheetGroup::chain
  std::vector<char> adapted_;                        // per vertex: it has a virtual intersection point
  std::vector<std::array<int, 8>> vertex_of_sheet_;  // per cell, −1
  std::vector<Midpoint> midpoints_;
  std::unordered_map<std::int64_t, int> midpoint_of_arc_;
};

}  // namespace cfem_cutting
