#include "cfem_cutting/surface/tissue_surface.h"

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

void place(const TissueSurface& surface, const CompositeMesh& mesh, const NodeField& x, const Polyline& front,
           DeformedSurface& drawn) {
  drawn.positions.resize(drawn.source.size());
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const SurfaceVertex& vertex = surface.vertices[v];
    const Vec3 p = mesh.embed(vertex.voxel, vertex.X).apply(x);
    drawn.positions[v] = vertex.on_front && front.size() > 1 ? on_edge(vertex, front, p) : p;
  }
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
