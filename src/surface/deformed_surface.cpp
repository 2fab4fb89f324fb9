#include "cfem_cutting/surface/tissue_surface.h"
#include "edge_pull.h"

namespace cfem_cutting {
namespace {

/// A vertex of both skin and cut triangles gets a double, which the cut triangles use.
void double_rim(const TissueSurface& surface, DeformedSurface& drawn) {
  const std::size_t count = surface.vertices.size();
  std::vector<std::uint8_t> uses(count, 0);  // bit 0: skin, bit 1: cut
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int v : surface.triangles[t]) uses[v] |= surface.cut[t] ? 2 : 1;
  std::vector<int> of_cut(count);
  drawn.source.resize(count);
  for (std::size_t v = 0; v < count; ++v) of_cut[v] = drawn.source[v] = static_cast<int>(v);
  for (std::size_t v = 0; v < count; ++v) {
    if (uses[v] != 3) continue;
    of_cut[v] = static_cast<int>(drawn.source.size());
    drawn.source.push_back(static_cast<int>(v));
  }
  drawn.triangles = surface.triangles;
  drawn.cut = surface.cut;
  drawn.label = surface.label;
  for (std::size_t t = 0; t < drawn.triangles.size(); ++t)
    if (drawn.cut[t])
      for (int& v : drawn.triangles[t]) v = of_cut[v];
}

/// Where the edge holds a vertex that the deformation takes to p.
Vec3 on_edge(const SurfaceVertex& vertex, const Polyline& front, const Vec3& p) {
  if (vertex.edge_end == EdgeEnd::kHeel) return front.front();
  if (vertex.edge_end == EdgeEnd::kTip) return front.back();
  return project(front, p).point;
}

/// How far around a vertex that the edge holds others are drawn along.
double pull_reach(const CompositeMesh& mesh) {
  constexpr double kVoxels = 2.0;
  return kVoxels * mesh.block_size().minCoeff() / (1 << mesh.level());
}

/// Vertices that the edge holds on it, and what is around a cut's end along with it.
void put_on_edge(const TissueSurface& surface, const Polyline& front, double reach,
                 std::vector<Vec3>& positions) {
  EdgePull pull(reach);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const SurfaceVertex& vertex = surface.vertices[v];
    if (!vertex.on_front) continue;
    const Vec3 held = on_edge(vertex, front, positions[v]);
    if (vertex.cut_end) pull.add(vertex.X, held - positions[v]);
    positions[v] = held;
  }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    if (!surface.vertices[v].on_front) positions[v] += pull.at(surface.vertices[v].X);
}

void place(const TissueSurface& surface, const CompositeMesh& mesh, const NodeField& x, const Polyline& front,
           DeformedSurface& drawn) {
  drawn.positions.resize(drawn.source.size());
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    drawn.positions[v] = mesh.embed(surface.vertices[v].voxel, surface.vertices[v].X).apply(x);
  if (front.size() > 1) put_on_edge(surface, front, pull_reach(mesh), drawn.positions);
  for (std::size_t v = surface.vertices.size(); v < drawn.source.size(); ++v)
    drawn.positions[v] = drawn.positions[drawn.source[v]];
}

/// Normals weighted by area; where they cancel (the two faces meet at a cut's end), that of the last
/// triangle.
void find_normals(DeformedSurface& drawn) {
  const std::size_t count = drawn.positions.size();
  std::vector<Vec3> last(count, Vec3::UnitZ());
  std::vector<double> weight(count, 0.0);
  drawn.normals.assign(count, Vec3::Zero());
  for (const auto& triangle : drawn.triangles) {
    const Vec3& a = drawn.positions[triangle[0]];
    const Vec3 area = (drawn.positions[triangle[1]] - a).cross(drawn.positions[triangle[2]] - a);
    const double size = area.norm();
    if (!(size > 0.0)) continue;
    for (const int v : triangle) {
      drawn.normals[v] += area;
      weight[v] += size;
      last[v] = area / size;
    }
  }
  constexpr double kCancelled = 1e-6;
  for (std::size_t v = 0; v < count; ++v) {
    const double length = drawn.normals[v].norm();
    drawn.normals[v] = length > kCancelled * weight[v] ? Vec3(drawn.normals[v] / length) : last[v];
  }
}

}  // namespace

DeformedSurface deform(const TissueSurface& surface, const CompositeMesh& mesh, const NodeField& x,
                       const Polyline& front) {
  DeformedSurface drawn;
  double_rim(surface, drawn);
  place(surface, mesh, x, front, drawn);
  find_normals(drawn);
  return drawn;
}

}  // namespace cfem_cutting
