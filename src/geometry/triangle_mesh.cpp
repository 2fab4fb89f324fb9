#include "cfem_cutting/geometry/triangle_mesh.h"

#include <algorithm>
#include <numeric>

namespace cfem_cutting {
namespace {

/// A triangle's edge, as an unordered pair with the direction in which the triangle uses it.
struct HalfEdge {
  int low, high;
  int direction;  ///< 1 from low to high, −1 back
  bool same_edge(const HalfEdge& o) const { return low == o.low && high == o.high; }
};

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const int from = triangle[corner], to = triangle[(corner + 1) % 3];
      half_edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  return half_edges;
}

void count_bad_edges(const TriangleMesh& mesh, MeshDefects& defects) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  for (auto begin = half_edges.begin(); begin != half_edges.end();) {
    const auto end =
        std::find_if(begin, half_edges.end(), [&](const HalfEdge& e) { return !e.same_edge(*begin); });
    const int balance =
        std::accumulate(begin, end, 0, [](int sum, const HalfEdge& e) { return sum + e.direction; });
    const Vec3 middle = 0.5 * (mesh.vertices[begin->low] + mesh.vertices[begin->high]);
    if (balance != 0 && defects.open_edges++ == 0) defects.open_edge_at = middle;
    if (end - begin > 2 && defects.nonmanifold_edges++ == 0) defects.nonmanifold_at = middle;
    begin = end;
  }
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Triangles around one vertex, each given by its two other vertices, form one fan if joining those that
/// share another vertex leaves a single group.
bool is_one_fan(const std::vector<std::array<int, 2>>& opposite_edges) {
  std::vector<int> group(opposite_edges.size());
  std::iota(group.begin(), group.end(), 0);
  std::vector<std::pair<int, int>> triangle_of_vertex;
  for (int i = 0; i < static_cast<int>(opposite_edges.size()); ++i)
    for (const int vertex : opposite_edges[i]) triangle_of_vertex.emplace_back(vertex, i);
  std::sort(triangle_of_vertex.begin(), triangle_of_vertex.end());
  for (std::size_t k = 1; k < triangle_of_vertex.size(); ++k) {
    if (triangle_of_vertex[k].first != triangle_of_vertex[k - 1].first) continue;
    group[root(group, triangle_of_vertex[k].second)] = root(group, triangle_of_vertex[k - 1].second);
  }
  for (int i = 0; i < static_cast<int>(group.size()); ++i)
    if (root(group, i) != root(group, 0)) return false;
  return true;
}

void count_bad_vertices(const TriangleMesh& mesh, MeshDefects& defects) {
  std::vector<std::vector<std::array<int, 2>>> opposite_edges(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      opposite_edges[triangle[corner]].push_back({triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]});
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (is_one_fan(opposite_edges[v])) continue;
    if (defects.manifold()) defects.nonmanifold_at = mesh.vertices[v];
    ++defects.nonmanifold_vertices;
  }
}

}  // namespace

double enclosed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Vec3 apex = mesh.vertices.front();
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes += (mesh.vertices[a] - apex).dot((mesh.vertices[b] - apex).cross(mesh.vertices[c] - apex));
  return six_volumes / 6.0;
}

MeshDefects find_defects(const TriangleMesh& mesh) {
  MeshDefects defects;
  count_bad_edges(mesh, defects);
  count_bad_vertices(mesh, defects);
  return defects;
}

}  // namespace cfem_cutting
