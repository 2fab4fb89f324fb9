#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <set>

#include "surface_check.h"

namespace cfem_cutting::random_cuts {

namespace processing = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

std::int64_t count_self_crossings(const TissueSurface& surface) {
  Mesh mesh;
  for (const SurfaceVertex& v : surface.vertices) mesh.add_vertex({v.X.x(), v.X.y(), v.X.z()});
  for (const auto& [a, b, c] : surface.triangles)
    mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  const auto part_of = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:part", 0).first;
  std::vector<std::vector<Mesh::Face_index>> parts(processing::connected_components(mesh, part_of));
  for (const Mesh::Face_index face : mesh.faces()) parts[part_of[face]].push_back(face);
  std::set<Mesh::Face_index> crossing;
  for (const auto& faces : parts) {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    processing::self_intersections(faces, mesh, std::back_inserter(pairs));
    for (const auto& [a, b] : pairs) {
      crossing.insert(a);
      crossing.insert(b);
    }
  }
  return static_cast<std::int64_t>(crossing.size());
}

}  // namespace cfem_cutting::random_cuts
