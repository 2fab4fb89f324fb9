#pragma once

#include <array>
#include <string>
#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// Indexed triangles, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<int, 3>> triangles;
};

/// Signed volume enclosed by a closed mesh (divergence theorem), m³; positive if oriented outward.
double enclosed_volume(const TriangleMesh& mesh);

/// How a mesh fails to be a closed surface; all zero if it doesn't.
struct MeshDefects {
  int open_edges = 0;                  ///< edges whose two directions are not used equally often
  int nonmanifold_edges = 0;           ///< edges of more than two triangles
  int nonmanifold_vertices = 0;        ///< vertices whose triangles are not one fan
  Vec3 open_edge_at = Vec3::Zero();    ///< middle of an open edge, m
  Vec3 nonmanifold_at = Vec3::Zero();  ///< middle of a non-manifold edge, else a non-manifold vertex, m
  bool closed() const { return open_edges == 0; }
  bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};
MeshDefects find_defects(const TriangleMesh& mesh);

/// Reads STL, OBJ, PLY or OFF; coincident vertices are merged.
/// @throw FileError missing, unreadable or without triangles.
TriangleMesh read_mesh(const std::string& path);

/// Binary little-endian PLY with per-face uchar properties `cut` and `label`.
/// @param cut one flag per triangle
/// @param label of the tissue that each triangle bounds
/// @throw FileError path not writable.
void write_ply(const std::string& path, const TriangleMesh& mesh, const std::vector<std::uint8_t>& cut,
               const std::vector<std::uint8_t>& label);

}  // namespace cfem_cutting
