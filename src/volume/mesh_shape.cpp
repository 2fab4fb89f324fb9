#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/geometry/predicates.h"
#include "cfem_cutting/volume/shapes.h"
#include "label_change.h"
#include "triangle_grid.h"

namespace cfem_cutting {
namespace {

Eigen::Vector2d xy(const Vec3& p) { return p.head<2>(); }

int sign(double x) { return (x > 0.0) - (x < 0.0); }

/// Side of edge ab on which the column at p lies; on a tie the column is taken as shifted by (ε, ε²), so that
/// exactly one of two triangles at an edge, and of a fan at a vertex, is met (simulation of simplicity,
/// Edelsbrunner and Mücke 1990). 0 only if a and b coincide in xy.
int side_of_edge(const Vec3& a, const Vec3& b, const Eigen::Vector2d& p) {
  const int exact = orient2d(xy(a), xy(b), p);
  if (exact != 0) return exact;
  return a.y() != b.y() ? sign(a.y() - b.y()) : sign(b.x() - a.x());
}

/// Where a column meets the surface. `turn`: 1 where tissue begins going up, −1 where it ends.
struct ColumnCrossing {
  double z;
  int turn;
};

struct MeshTriangle {
  Vec3 a, b, c;
  Vec3 normal() const { return (b - a).cross(c - a); }
};

std::optional<ColumnCrossing> meet_column(const MeshTriangle& t, const Eigen::Vector2d& p) {
  const auto beyond = [&](int axis) {
    return std::max({t.a[axis], t.b[axis], t.c[axis]}) < p[axis] ||
           std::min({t.a[axis], t.b[axis], t.c[axis]}) > p[axis];
  };
  if (beyond(0) || beyond(1)) return std::nullopt;
  const int side = side_of_edge(t.a, t.b, p);
  if (side == 0 || side_of_edge(t.b, t.c, p) != side || side_of_edge(t.c, t.a, p) != side)
    return std::nullopt;
  const Vec3 normal = t.normal();
  const double lowest = std::min({t.a.z(), t.b.z(), t.c.z()});
  const double highest = std::max({t.a.z(), t.b.z(), t.c.z()});
  const double z = t.a.z() - normal.head<2>().dot(p - xy(t.a)) / normal.z();
  return ColumnCrossing{std::isfinite(z) ? std::clamp(z, lowest, highest) : lowest, -side};
}

/// Where a segment leaves tissue through a triangle.
struct SegmentExit {
  double t;          ///< along the segment
  Vec3 barycentric;  ///< of a, b, c
};

/// Möller and Trumbore 1997, with a tolerance so that no segment slips through an edge.
std::optional<SegmentExit> leave_through(const MeshTriangle& t, const Vec3& from, const Vec3& along) {
  constexpr double kTolerance = 1e-9;
  const Vec3 ab = t.b - t.a, ac = t.c - t.a;
  const Vec3 p = along.cross(ac);
  const double determinant = ab.dot(p);  // negative where the segment runs along the outward normal
  if (!(determinant < 0.0)) return std::nullopt;
  const Vec3 offset = from - t.a;
  const Vec3 q = offset.cross(ab);
  const double v = offset.dot(p) / determinant, w = along.dot(q) / determinant, at = ac.dot(q) / determinant;
  const bool in_triangle = v >= -kTolerance && w >= -kTolerance && v + w <= 1.0 + kTolerance;
  if (!in_triangle || at < -kTolerance || at > 1.0 + kTolerance) return std::nullopt;
  return SegmentExit{std::clamp(at, 0.0, 1.0), {1.0 - v - w, v, w}};
}

/// Weighted by the triangles' angles (Thürmer and Wüthrich 1998).
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& p = mesh.vertices[triangle[corner]];
      const Vec3 to_next = mesh.vertices[triangle[(corner + 1) % 3]] - p;
      const Vec3 to_previous = mesh.vertices[triangle[(corner + 2) % 3]] - p;
      const Vec3 cross = to_next.cross(to_previous);
      if (cross.norm() > 0.0)
        normals[triangle[corner]] += std::atan2(cross.norm(), to_next.dot(to_previous)) * cross.normalized();
    }
  }
  for (Vec3& normal : normals) normal.normalize();
  return normals;
}

class MeshShape final : public Shape {
 public:
  explicit MeshShape(TriangleMesh mesh)
      : mesh_(std::move(mesh)), normals_(vertex_normals(mesh_)), columns_(mesh_, 2), cells_(mesh_, 3) {
    for (const Vec3& vertex : mesh_.vertices) bounds_.extend(vertex);
  }

  Box bounds() const override { return bounds_; }

  std::vector<int> labels_along_z(double x, double y, const std::vector<double>& z) const override {
    const std::vector<ColumnCrossing> crossings = column_crossings({x, y});
    std::vector<int> labels(z.size());
    std::size_t passed = 0;
    int winding = 0;
    for (std::size_t n = 0; n < z.size(); ++n) {
      for (; passed < crossings.size() && crossings[passed].z <= z[n]; ++passed)
        winding += crossings[passed].turn;
      labels[n] = winding > 0 ? 0 : -1;
    }
    return labels;
  }

  SurfacePoint exit(const Vec3& inside, const Vec3& outside) const override {
    std::optional<SegmentExit> last;
    int last_triangle = -1;
    Box box(inside);
    box.extend(outside);
    cells_.visit(box, [&](int t) {
      const std::optional<SegmentExit> candidate = leave_through(triangle(t), inside, outside - inside);
      if (!candidate || (last && candidate->t <= last->t)) return;
      last = candidate;
      last_triangle = t;
    });
    if (!last) return {find_label_change(*this, inside, outside), (outside - inside).normalized()};
    return {inside + last->t * (outside - inside), smooth_normal(last_triangle, last->barycentric)};
  }

  double volume() const override { return enclosed_volume(mesh_); }

 private:
  MeshTriangle triangle(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }

  std::vector<ColumnCrossing> column_crossings(const Eigen::Vector2d& p) const {
    std::vector<ColumnCrossing> crossings;
    const Vec3 on_column(p.x(), p.y(), bounds_.min().z());
    columns_.visit(Box(on_column), [&](int t) {
      if (const auto crossing = meet_column(triangle(t), p)) crossings.push_back(*crossing);
    });
    std::sort(crossings.begin(), crossings.end(), [](const ColumnCrossing& a, const ColumnCrossing& b) {
      return a.z != b.z ? a.z < b.z : a.turn > b.turn;
    });
    return crossings;
  }

  /// Interpolated between the vertices, but for those at a crease.
  Vec3 smooth_normal(int t, const Vec3& barycentric) const {
    constexpr double kCosineOfCrease = 0.77;  // 40°
    const Vec3 flat = triangle(t).normal().normalized();
    Vec3 normal = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& at_vertex = normals_[mesh_.triangles[t][corner]];
      normal += barycentric[corner] * (at_vertex.dot(flat) > kCosineOfCrease ? at_vertex : flat);
    }
    return normal.normalized();
  }

  TriangleMesh mesh_;
  std::vector<Vec3> normals_;
  TriangleGrid columns_, cells_;
  Box bounds_;
};

std::string describe(const Vec3& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ") of the mesh";
  return text.str();
}

void refuse_unless_closed(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty())
    throw GeometryError("mesh '" + name + "': no triangles; a closed mesh is needed");
  const MeshDefects defects = find_defects(mesh);
  if (!defects.closed())
    throw GeometryError("mesh '" + name + "': " + std::to_string(defects.open_edges) +
                        " open edges, one at " + describe(defects.open_edge_at) +
                        "; a closed, evenly oriented mesh is needed");
  if (!defects.manifold())
    throw GeometryError("mesh '" + name + "': " + std::to_string(defects.nonmanifold_edges) +
                        " non-manifold edges and " + std::to_string(defects.nonmanifold_vertices) +
                        " vertices where the surface touches itself, one at " +
                        describe(defects.nonmanifold_at) + "; a manifold mesh is needed");
}

void turn_outward(TriangleMesh& mesh, const std::string& name) {
  const double volume = enclosed_volume(mesh);
  if (!(std::abs(volume) > 0.0)) throw GeometryError("mesh '" + name + "': encloses no volume");
  if (volume < 0.0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
}

}  // namespace

std::unique_ptr<Shape> make_mesh_shape(TriangleMesh mesh, double scale, const Pose& X_TS,
                                       const std::string& name) {
  if (!(scale > 0.0)) throw GeometryError("mesh '" + name + "': scale must be greater than 0");
  refuse_unless_closed(mesh, name);
  for (Vec3& vertex : mesh.vertices) vertex = X_TS * (scale * vertex);
  turn_outward(mesh, name);
  return std::make_unique<MeshShape>(std::move(mesh));
}

}  // namespace cfem_cutting
