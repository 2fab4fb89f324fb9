#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cassert>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/geometry/triangle_mesh.h"

namespace cfem_cutting {
namespace {

/// Keep positions only, so that vertices split by normals or colours are joined again.
constexpr int kIgnoredComponents = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                   aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                   aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                   aiComponent_CAMERAS | aiComponent_MATERIALS;

Vec3 to_eigen(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void append_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, TriangleMesh& mesh) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const int first = static_cast<int>(mesh.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v)
      mesh.vertices.push_back(to_eigen(transform * part.mVertices[v]));
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const int* index = reinterpret_cast<const int*>(face.mIndices);
      mesh.triangles.push_back({first + index[0], first + index[1], first + index[2]});
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) append_node(scene, *node.mChildren[i], transform, mesh);
}

bool lexicographic_less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Merges equal vertices, drops unused ones and the triangles that lose their area by it.
TriangleMesh merge_coincident(const TriangleMesh& mesh) {
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return lexicographic_less(mesh.vertices[a], mesh.vertices[b]); });
  std::vector<int> representative(mesh.vertices.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeats = k > 0 && mesh.vertices[order[k]] == mesh.vertices[order[k - 1]];
    representative[order[k]] = repeats ? representative[order[k - 1]] : order[k];
  }

  TriangleMesh merged;
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (auto triangle : mesh.triangles) {
    for (int& vertex : triangle) vertex = representative[vertex];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    for (int& vertex : triangle) {
      int& index = new_index[vertex];
      if (index < 0) {
        index = static_cast<int>(merged.vertices.size());
        merged.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = index;
    }
    merged.triangles.push_back(triangle);
  }
  return merged;
}

template <typename Value>
void put(std::ofstream& file, const Value& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

void write_ply_header(std::ofstream& file, const TriangleMesh& mesh) {
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
       << "\nproperty list uchar int vertex_indices\nproperty uchar cut\nproperty uchar label\nend_header\n";
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw FileError("mesh file '" + path + "': not found; an STL, OBJ, PLY or OFF file is needed");
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kIgnoredComponents);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (!scene || !scene->mRootNode)
    throw FileError("mesh file '" + path + "': not readable as a mesh: " + importer.GetErrorString());
  TriangleMesh mesh;
  append_node(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  mesh = merge_coincident(mesh);
  if (mesh.triangles.empty())
    throw FileError("mesh file '" + path + "': no triangles; a closed triangle mesh is needed");
  return mesh;
}

void write_ply(const std::string& path, const TriangleMesh& mesh, const std::vector<std::uint8_t>& cut,
               const std::vector<std::uint8_t>& label) {
  assert(cut.size() == mesh.triangles.size() && label.size() == mesh.triangles.size());
  std::ofstream file(path, std::ios::binary);
  write_ply_header(file, mesh);
  for (const Vec3& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) put(file, static_cast<float>(vertex[axis]));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put(file, std::uint8_t{3});
    for (const int vertex : mesh.triangles[t]) put(file, std::int32_t{vertex});
    put(file, cut[t]);
    put(file, label[t]);
  }
  file.flush();
  if (!file) throw FileError("surface file '" + path + "': not writable");
}

}  // namespace cfem_cutting
