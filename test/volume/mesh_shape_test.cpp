#include <gtest/gtest.h>

#include <map>
#include <random>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"
#include "cfem_cutting/volume/voxel_volume.h"

namespace cfem_cutting {
namespace {

/// Octahedron, each triangle split into four `levels` times, on a sphere about the origin.
TriangleMesh sphere(double radius, int levels) {
  TriangleMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), int(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& vertex : mesh.vertices) vertex *= radius;
  return mesh;
}

TriangleMesh unit_cube() {
  TriangleMesh mesh;
  for (int n = 0; n < 8; ++n) mesh.vertices.emplace_back(n & 1, n >> 1 & 1, n >> 2);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

TriangleMesh together(TriangleMesh first, const TriangleMesh& second) {
  const int offset = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles)
    first.triangles.push_back({a + offset, b + offset, c + offset});
  return first;
}

std::unique_ptr<Shape> shape_of(const TriangleMesh& mesh) {
  return make_mesh_shape(mesh, 1.0, Pose::Identity(), "test.stl");
}

double sampled_volume(const Shape& shape, double spacing) {
  const VoxelVolume volume = VoxelVolume::sample(shape, Vec3::Constant(spacing));
  double total = 0.0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) total += volume.filled_volume(v);
  return total;
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    shape_of(mesh);
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshShape, SphereKeepsItsVolume) {
  const auto shape = shape_of(sphere(0.05, 4));
  EXPECT_NEAR(sampled_volume(*shape, 0.004) / shape->volume(), 1.0, 0.005);
  EXPECT_NEAR(shape->volume(), 4.0 / 3.0 * M_PI * std::pow(0.05, 3), 0.01 * shape->volume());
}

TEST(MeshShape, SurfaceLinksMeetTheSphere) {
  const VoxelVolume volume = VoxelVolume::sample(*shape_of(sphere(0.05, 5)), Vec3::Constant(0.004));
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    for (int direction = 0; volume.voxel(v).linked() && direction < kDirections; ++direction) {
      if (volume.voxel(v).link[direction] != LinkState::kSurface) continue;
      const SurfacePoint& crossing = volume.crossing(v, direction);
      EXPECT_NEAR(crossing.point.norm(), 0.05, 0.0001);
      EXPECT_GT(crossing.normal.dot(crossing.point.normalized()), 0.9999);
      EXPECT_NEAR(crossing.normal.norm(), 1.0, 1e-12);
    }
  }
}

TEST(MeshShape, ColumnsThroughVerticesAndEdgesCountAsShifted) {
  const auto cube = shape_of(unit_cube());
  const std::vector<double> z{-0.5, 0.5, 1.5};
  const std::vector<int> through{-1, 0, -1}, past{-1, -1, -1};
  for (const double t : {0.0, 0.25, 0.5, 0.75}) {
    EXPECT_EQ(cube->labels_along_z(t, t, z), through) << t;
    EXPECT_EQ(cube->labels_along_z(t, 1.0 - t, z), t == 0.0 ? past : through) << t;
    EXPECT_EQ(cube->labels_along_z(0.0, t, z), through) << t;
    EXPECT_EQ(cube->labels_along_z(t, 0.0, z), through) << t;
    EXPECT_EQ(cube->labels_along_z(1.0, t, z), past) << t;
    EXPECT_EQ(cube->labels_along_z(t, 1.0, z), past) << t;
  }
}

TEST(MeshShape, NoColumnLeaksThroughAVertexOfATurnedMesh) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    TriangleMesh mesh = sphere(1.0, 2);
    const Eigen::AngleAxisd turn(
        3.0 * coordinate(random),
        Vec3(coordinate(random), coordinate(random), coordinate(random)).normalized());
    for (Vec3& vertex : mesh.vertices) vertex = turn * vertex;
    const auto shape = shape_of(mesh);
    for (const Vec3& vertex : mesh.vertices) {
      const std::vector<int> labels = shape->labels_along_z(vertex.x(), vertex.y(), {-1.1, 0.0, 1.1});
      EXPECT_EQ(labels.front(), -1) << "trial " << trial;
      EXPECT_EQ(labels.back(), -1) << "trial " << trial;
      if (vertex.head<2>().norm() < 0.9) {
        EXPECT_EQ(labels[1], 0) << "trial " << trial;
      }
    }
  }
}

TEST(MeshShape, CreasesStaySharp) {
  const auto cube = shape_of(unit_cube());
  const SurfacePoint near_corner = cube->exit({0.95, 0.97, 0.9}, {1.2, 0.97, 0.9});
  EXPECT_TRUE(near_corner.point.isApprox(Vec3(1.0, 0.97, 0.9), 1e-12));
  EXPECT_TRUE(near_corner.normal.isApprox(Vec3::UnitX()));
}

TEST(MeshShape, ExitThroughAnEdgeOrVertexIsFound) {
  const auto ball = shape_of(sphere(1.0, 1));
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)}) {
    const Vec3 direction = axis.normalized();
    const SurfacePoint exit = ball->exit(Vec3::Zero(), 2.0 * direction);
    EXPECT_NEAR(exit.point.norm(), 1.0, 1e-9);
    EXPECT_GT(exit.normal.dot(direction), 0.99);
  }
}

TEST(MeshShape, LastExitOfSeveral) {
  TriangleMesh second = sphere(1.0, 2);
  for (Vec3& vertex : second.vertices) vertex += Vec3(3.0, 0.0, 0.0);
  const auto both = shape_of(together(sphere(1.0, 2), second));
  EXPECT_NEAR(both->exit({0, 0, 0}, {5, 0, 0}).point.x(), 4.0, 1e-9);
}

TEST(MeshShape, InwardMeshIsTurned) {
  const auto shape = shape_of(turned(sphere(0.05, 3)));
  EXPECT_GT(shape->volume(), 0.0);
  EXPECT_EQ(shape->labels_along_z(0.001, 0.002, {0.0}).front(), 0);
  EXPECT_GT(shape->exit(Vec3::Zero(), Vec3(0.1, 0.001, 0.002)).normal.x(), 0.99);
}

TEST(MeshShape, CavityIsEmpty) {
  const auto shell = shape_of(together(sphere(0.05, 4), turned(sphere(0.03, 4))));
  EXPECT_EQ(shell->labels_along_z(0.001, 0.002, {-0.04, 0.0, 0.04}), (std::vector<int>{0, -1, 0}));
  EXPECT_NEAR(sampled_volume(*shell, 0.004) / shell->volume(), 1.0, 0.005);
}

TEST(MeshShape, ScaleThenPose) {
  Pose X_TS = Pose::Identity();
  X_TS.translate(Vec3(1.0, 2.0, 3.0));
  X_TS.rotate(Eigen::AngleAxisd(0.5 * M_PI, Vec3::UnitZ()));
  const auto shape = make_mesh_shape(unit_cube(), 0.1, X_TS, "test.stl");
  EXPECT_TRUE(shape->bounds().min().isApprox(Vec3(0.9, 2.0, 3.0)));
  EXPECT_TRUE(shape->bounds().max().isApprox(Vec3(1.0, 2.1, 3.1)));
  EXPECT_NEAR(shape->volume(), 1e-3, 1e-15);
}

TEST(MeshShape, RefusesOpenMeshesAndSaysWhere) {
  TriangleMesh open = unit_cube();
  open.triangles.pop_back();
  EXPECT_EQ(refusal(open),
            "mesh 'test.stl': 3 open edges, one at (1, 0.5, 0.5) of the mesh; a closed, evenly oriented mesh "
            "is needed");
}

TEST(MeshShape, RefusesTouchingEmptyAndFlatMeshes) {
  TriangleMesh touching = together(unit_cube(), unit_cube());
  for (int n = 8; n < 16; ++n) touching.vertices[n] -= Vec3(1.0, 1.0, 1.0);
  for (auto& triangle : touching.triangles)
    for (int& vertex : triangle)
      if (vertex == 15) vertex = 0;
  EXPECT_NE(refusal(touching).find("0 non-manifold edges and 1 vertices"), std::string::npos)
      << refusal(touching);
  EXPECT_NE(refusal({}).find("no triangles"), std::string::npos);
  EXPECT_NE(refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}).find("encloses no volume"),
            std::string::npos);
  EXPECT_THROW(make_mesh_shape(unit_cube(), 0.0, Pose::Identity(), "test.stl"), GeometryError);
}

}  // namespace
}  // namespace cfem_cutting
