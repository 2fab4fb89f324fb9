#include "element_kinds.h"
#include "record.h"
#include "reference_element.h"
#include "two_materials.h"

namespace cfem_cutting {
namespace {

const char* const kSource = "Taylor, Beresford and Wilson (1976)";

void cut_half(VoxelVolume& volume) {
  const Vec3 middle = volume.centre(static_cast<int>(volume.voxels().size()) / 2);
  sever_plane(volume, middle, Vec3(1.0, 0.4, 0.2).normalized(),
              [&](const Vec3& X) { return X.z() < middle.z(); });
}

bool has_severed_link(const VoxelVolume& volume, const CompositeElement& element) {
  for (int v : element.voxels)
    for (LinkState link : volume.voxel(v).link)
      if (volume.voxel(v).linked() && link == LinkState::kSevered) return true;
  return false;
}

/// The affine positions of every node of every cut or partly filled element, and of the body's faces.
HeldNodes prescribe_affine(const VoxelVolume& volume, const CompositeMesh& mesh, const Mat3& F) {
  std::vector<int> uses(mesh.node_count(), 0);
  std::vector<char> prescribed(mesh.node_count(), 0);
  for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e) {
    const CompositeElement& element = mesh.elements()[e];
    const bool plain = is_whole(volume, mesh, e) && !has_severed_link(volume, element);
    for (int node : element.nodes) {
      ++uses[node];
      if (!plain) prescribed[node] = 1;
    }
  }
  HeldNodes held;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (!prescribed[n] && uses[n] == 8) continue;
    held.nodes.push_back(n);
    held.positions.push_back(F * mesh.rest().col(n));
  }
  return held;
}

/// Largest deviation of the free nodes from the affine field, over the body's size.
double patch_error(const VoxelVolume& volume, int level, const std::vector<Material>& materials,
                   ElementKind kind) {
  const ElasticModel model(volume, level, materials, kind, Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  const Mat3 F = (Mat3() << 1.01, 0.02, -0.01, 0.005, 0.98, 0.03, 0.0, 0.01, 1.015).finished();
  const HeldNodes held = prescribe_affine(volume, mesh, F);
  EXPECT_LT(static_cast<int>(held.nodes.size()), mesh.node_count());
  NodeField x = mesh.rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, Vec3::Zero(), held, {}).converged);
  const double size = (mesh.rest().rowwise().maxCoeff() - mesh.rest().rowwise().minCoeff()).norm();
  return (x - F * mesh.rest()).cwiseAbs().maxCoeff() / size;
}

class Patch : public testing::TestWithParam<ElementKind> {
 protected:
  std::string kind() const { return ", " + name_of(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Patch,
                         testing::Values(ElementKind::kTrilinear, ElementKind::kIncompatibleModes));

TEST_P(Patch, FreeNodesTakeTheAffineField) {
  Record record("Patch test, largest error over the body's size", kSource);
  const std::vector<Material> one{soft(0.45)}, equal = two_materials(soft(0.45), soft(0.45));
  for (int level : {0, 1}) {
    const std::string name = kind() + ", level " + std::to_string(level);
    VoxelVolume box = box_volume({0.08, 0.08, 0.08}, 0.01);
    record.at_most("full" + name, 1e-9, patch_error(box, level, one, GetParam()));
    cut_half(box);
    record.at_most("cut" + name, 1e-9, patch_error(box, level, one, GetParam()));
    VoxelVolume tilted = tilted_volume({0.08, 0.07, 0.06}, 0.005);
    record.at_most("partly filled" + name, 1e-9, patch_error(tilted, level, one, GetParam()));
    cut_half(tilted);
    record.at_most("partly filled and cut" + name, 1e-9, patch_error(tilted, level, one, GetParam()));
    record.at_most("two materials of equal values" + name, 1e-9,
                   patch_error(two_material_box(), level, equal, GetParam()));
  }
}

/// K_uu − K_condensed = K_ua K_aa⁻¹ K_au, with K_aa positive: it annuls a field if and only if K_au does.
double modes_in_affine_fields(const VoxelVolume& volume, int level, const std::vector<Material>& materials) {
  const ElasticModel with(volume, level, materials, ElementKind::kIncompatibleModes, Kinematics::kLinear);
  const ElasticModel without(volume, level, materials, ElementKind::kTrilinear, Kinematics::kLinear);
  double largest = 0.0;
  for (int e = 0; e < static_cast<int>(with.mesh().elements().size()); ++e) {
    for (int i = 0; i < 9; ++i) {
      const Mat3 G = Eigen::Map<const Mat3>(Eigen::Matrix<double, 9, 1>::Unit(i).eval().data());
      const Eigen::Matrix<double, 24, 1> u = affine_displacement(with.mesh(), e, G);
      const double scale = with.stiffness(e).norm() * u.norm();
      largest = std::max(largest, ((without.stiffness(e) - with.stiffness(e)) * u).norm() / scale);
    }
  }
  return largest;
}

TEST(Patch, AffineFieldsRaiseNoModes) {
  Record record("K_au · u for affine u, over ‖K‖ ‖u‖, largest of all elements", kSource);
  VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
  sever_plane(volume, {0.02, 0.02, 0.02}, Vec3(1.0, 0.4, 0.2).normalized());
  for (int level : {0, 1, 2, 3})
    record.at_most("partly filled and cut, level " + std::to_string(level), 1e-12,
                   modes_in_affine_fields(volume, level, {soft(0.45)}));
  record.at_most("two materials of equal values, partly filled, level 2", 1e-12,
                 modes_in_affine_fields(tilted_two_material_box(), 2, two_materials(soft(0.45), soft(0.45))));
}

}  // namespace
}  // namespace cfem_cutting
