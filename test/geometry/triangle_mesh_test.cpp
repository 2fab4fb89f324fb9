#include "cfem_cutting/geometry/triangle_mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

TriangleMesh tetrahedron(const Vec3& at = Vec3::Zero()) {
  return {{at, at + Vec3::UnitX(), at + Vec3::UnitY(), at + Vec3::UnitZ()},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Joins two meshes; vertices of the second equal to one of the first are shared.
TriangleMesh join(TriangleMesh first, const TriangleMesh& second) {
  std::vector<int> index;
  for (const Vec3& vertex : second.vertices) {
    const auto same = std::find(first.vertices.begin(), first.vertices.end(), vertex);
    index.push_back(static_cast<int>(same - first.vertices.begin()));
    if (same == first.vertices.end()) first.vertices.push_back(vertex);
  }
  for (const auto& [a, b, c] : second.triangles) first.triangles.push_back({index[a], index[b], index[c]});
  return first;
}

class MeshFiles : public testing::Test {
 protected:
  MeshFiles()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("cfem_cutting_mesh_files_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~MeshFiles() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

void expect_unit_tetrahedron(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(enclosed_volume(mesh), 1.0 / 6.0, 1e-12);
  EXPECT_TRUE(find_defects(mesh).closed());
}

TEST(TriangleMesh, VolumeIsSignedAndIndependentOfTheOrigin) {
  EXPECT_NEAR(enclosed_volume(tetrahedron({10, -20, 30})), 1.0 / 6.0, 1e-12);
  TriangleMesh inward = tetrahedron();
  for (auto& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(enclosed_volume(inward), -1.0 / 6.0, 1e-15);
}

TEST(TriangleMesh, ClosedMeshHasNoDefects) {
  const MeshDefects defects = find_defects(tetrahedron());
  EXPECT_TRUE(defects.closed());
  EXPECT_TRUE(defects.manifold());
}

TEST(TriangleMesh, MissingTriangleOpensThreeEdges) {
  TriangleMesh open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_EQ(find_defects(open).open_edges, 3);
  EXPECT_TRUE(find_defects(open).manifold());
}

TEST(TriangleMesh, FlippedTriangleOpensThreeEdges) {
  TriangleMesh twisted = tetrahedron();
  std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
  EXPECT_EQ(find_defects(twisted).open_edges, 3);
}

TEST(TriangleMesh, SharedEdgeIsNotManifold) {
  const TriangleMesh other{{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const MeshDefects defects = find_defects(join(tetrahedron(), other));
  EXPECT_TRUE(defects.closed());
  EXPECT_EQ(defects.nonmanifold_edges, 1);
}

TEST(TriangleMesh, SharedVertexIsNotManifold) {
  const MeshDefects defects = find_defects(join(tetrahedron(), tetrahedron(Vec3::UnitX())));
  EXPECT_TRUE(defects.closed());
  EXPECT_EQ(defects.nonmanifold_edges, 0);
  EXPECT_EQ(defects.nonmanifold_vertices, 1);
}

TEST_F(MeshFiles, ReadsOffAndObj) {
  expect_unit_tetrahedron(read_mesh(
      write("t.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")));
  expect_unit_tetrahedron(
      read_mesh(write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")));
}

TEST_F(MeshFiles, MergesTheSeparateCornersOfStl) {
  const TriangleMesh mesh = tetrahedron();
  std::string text = "solid t\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int vertex : triangle) {
      const Vec3& p = mesh.vertices[vertex];
      text += "vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) +
              "\n";
    }
    text += "endloop\nendfacet\n";
  }
  expect_unit_tetrahedron(read_mesh(write("t.stl", text + "endsolid t\n")));
}

TEST_F(MeshFiles, MergesVerticesThatNormalsKeepApart) {
  expect_unit_tetrahedron(
      read_mesh(write("n.obj",
                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 -1 0\nvn -1 0 0\nvn 1 1 1\n"
                      "f 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 1//3 4//3 3//3\nf 2//4 3//4 4//4\n")));
}

TEST_F(MeshFiles, PlyRoundTripKeepsMeshAndFlags) {
  write_ply(path("t.ply"), tetrahedron(), {0, 1, 0, 1}, {7, 7, 8, 9});
  expect_unit_tetrahedron(read_mesh(path("t.ply")));
  std::ifstream file(path("t.ply"), std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(file)), {});
  const std::string header_end = "property uchar cut\nproperty uchar label\nend_header\n";
  const auto body = content.find(header_end);
  ASSERT_NE(body, std::string::npos);
  const auto faces = body + header_end.size() + 4 * 12;
  ASSERT_EQ(content.size(), faces + 4 * 15);
  const int labels[] = {7, 7, 8, 9};
  for (int t = 0; t < 4; ++t) {
    EXPECT_EQ(content[faces + 15 * t + 13], t % 2);
    EXPECT_EQ(content[faces + 15 * t + 14], labels[t]);
  }
}

TEST_F(MeshFiles, RefusesMissingAndUnreadableFiles) {
  try {
    read_mesh(path("none.stl"));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("none.stl': not found"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_mesh(write("bad.off", "not a mesh")), FileError);
  EXPECT_THROW(read_mesh(write("points.obj", "v 0 0 0\nv 1 0 0\n")), FileError);
  EXPECT_THROW(write_ply(path("no/such/folder.ply"), tetrahedron(), {0, 0, 0, 0}, {0, 0, 0, 0}), FileError);
}

}  // namespace
}  // namespace cfem_cutting
