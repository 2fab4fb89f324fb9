#include <Eigen/Eigenvalues>

#include "direct_problem.h"
#include "element_kinds.h"
#include "record.h"
#include "reference_element.h"
#include "two_materials.h"

namespace cfem_cutting {
namespace {

class Composites : public testing::TestWithParam<ElementKind> {
 protected:
  std::string kind() const { return name_of(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Composites,
                         testing::Values(ElementKind::kTrilinear, ElementKind::kIncompatibleModes));

/// Statics of a box under its weight, held below and dragged sideways.
NodeField settle(const ElasticModel& model) {
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.z() < 1e-9; });
  NodeField x = model.mesh().rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, {1.0, 0.5, -4.9}, held, {}, 60).converged);
  return x;
}

TEST_P(Composites, UncutEqualsThePlainMesh) {
  Record record("Uncut composite against the plain mesh of its level, relative", "identity");
  for (int level : {1, 2, 3}) {
    const ElasticModel composite(box_volume({0.16, 0.16, 0.24}, 0.01), level, {soft(0.45)}, GetParam(),
                                 Kinematics::kCorotational);
    const ElasticModel plain(box_volume({0.16, 0.16, 0.24}, 0.01 * (1 << level)), 0, {soft(0.45)}, GetParam(),
                             Kinematics::kCorotational);
    const std::string name = ", " + kind() + ", level " + std::to_string(level);
    const NodeField x = plain.mesh().rest() + random_displacement(plain.mesh().node_count(), 2e-3, 5);
    record.at_most("forces" + name, 1e-10,
                   (composite.forces(x) - plain.forces(x)).norm() / plain.forces(x).norm());
    const NodeField a = settle(composite), b = settle(plain);
    record.at_most("equilibrium" + name, 1e-10, (a - b).norm() / (b - plain.mesh().rest()).norm());
  }
}

/// Level 0: every voxel is a plain hexahedron, here from an independent integration.
TEST_P(Composites, LevelZeroIsTheFineMesh) {
  const VoxelVolume volume = two_material_box();
  const ElasticModel model(volume, 0, soft_and_stiff(), GetParam(), Kinematics::kLinear);
  double error = 0.0;
  for (int e = 0; e < static_cast<int>(model.mesh().elements().size()); ++e) {
    const ElementMatrix K = reference_stiffness(volume, model.mesh(), e, soft_and_stiff(), GetParam());
    error = std::max(error, (model.stiffness(e) - K).norm() / K.norm());
  }
  EXPECT_EQ(model.mesh().elements().size(), volume.voxels().size());
  Record record("Element matrices against an independent sum over integration points, relative", "identity");
  record.at_most("level 0, two materials, " + kind(), 1e-10, error);
}

/// Full blocks of two materials, exactly; and partly filled ones up to their stabilisation, which is small,
/// positive, and without effect on affine fields.
TEST_P(Composites, MixedElementsAreExactlyIntegrated) {
  Record record("Element matrices against an independent sum over integration points, relative", "identity");
  for (int level : {1, 2}) {
    const VoxelVolume volume = two_material_box();
    const ElasticModel model(volume, level, soft_and_stiff(), GetParam(), Kinematics::kLinear);
    double error = 0.0;
    for (int e = 0; e < static_cast<int>(model.mesh().elements().size()); ++e) {
      ASSERT_TRUE(is_whole(volume, model.mesh(), e));
      const ElementMatrix K = reference_stiffness(volume, model.mesh(), e, soft_and_stiff(), GetParam());
      error = std::max(error, (model.stiffness(e) - K).norm() / K.norm());
    }
    record.at_most("level " + std::to_string(level) + ", two materials in a block, " + kind(), 1e-10, error);
  }
}

TEST_P(Composites, StabilisationOfPartlyFilledElementsIsHarmless) {
  Record record("Stabilisation of partly filled elements", "K less an independent sum");
  VoxelVolume volume = tilted_two_material_box();
  sever_plane(volume, volume.centre(static_cast<int>(volume.voxels().size()) / 2), Vec3::UnitX());
  const ElasticModel model(volume, 1, soft_and_stiff(), GetParam(), Kinematics::kLinear);
  double size = 0.0, negative = 0.0, affine = 0.0;
  for (int e = 0; e < static_cast<int>(model.mesh().elements().size()); ++e) {
    const ElementMatrix& K = model.stiffness(e);
    const ElementMatrix added =
        K - reference_stiffness(volume, model.mesh(), e, soft_and_stiff(), GetParam());
    size = std::max(size, added.norm() / K.norm());
    const Eigen::SelfAdjointEigenSolver<ElementMatrix> eigen(added);
    negative = std::max(negative, -eigen.eigenvalues()[0] / K.norm());
    for (int i = 0; i < 9; ++i) {
      const Mat3 G = Eigen::Map<const Mat3>(Eigen::Matrix<double, 9, 1>::Unit(i).eval().data());
      const Eigen::Matrix<double, 24, 1> u = affine_displacement(model.mesh(), e, G);
      affine = std::max(affine, (added * u).norm() / K.norm() / u.norm());
    }
  }
  record.note("largest part of an element's matrix, " + kind(), size);
  record.at_most("most negative eigenvalue over ‖K‖, " + kind(), 1e-9, negative);
  record.at_most("effect on affine fields, " + kind(), 1e-12, affine);
}

/// Positions of an element's nodes.
Eigen::Matrix<double, 3, 8> corners_at(const VoxelVolume& volume, const CompositeMesh& mesh,
                                       const NodeField& x, const Vec3& X) {
  const int element = mesh.element_of_voxel(volume.find(volume.lattice().voxel_at(X)));
  Eigen::Matrix<double, 3, 8> corners;
  for (int n = 0; n < 8; ++n) corners.col(n) = x.col(mesh.elements()[element].nodes[n]);
  return corners;
}

/// The part of a body of 12 × 6 × 6 voxels where `keep` holds; a stray voxel at the lattice's first corner
/// keeps the blocks where they are in the whole body.
VoxelVolume part(const std::function<bool(const Vec3&)>& keep) {
  LabelImage image{{13, 6, 6}, Vec3::Constant(0.01), {}};
  const Lattice lattice{Vec3::Zero(), image.spacing, image.size};
  for (int i = 0; i < lattice.count(); ++i) {
    const Vec3i v(i % 13, i / 13 % 6, i / 78);
    const bool body = v.x() > 0 && keep(lattice.centre(v));
    image.labels.push_back(body || v == Vec3i(0, 0, 0) ? 1 : 0);
  }
  VoxelVolume volume =
      VoxelVolume::sample(*make_label_shape(image, {1}, Pose::Identity(), "part"), image.spacing);
  const int stray = volume.find(volume.lattice().voxel_at({0.005, 0.005, 0.005}));
  if (volume.voxel(stray).link[1] == LinkState::kIntact)
    volume.sever({stray, 0}, {{0.01, 0.005, 0.005}, Vec3::UnitX()});
  return volume;
}

TEST_P(Composites, SeveredMidPlaneIsTwoBodies) {
  Record record("Severed mid-plane against two bodies, over the body's size", "identity");
  const double middle = 0.07;
  VoxelVolume cut = part([](const Vec3&) { return true; });
  sever_plane(cut, {middle, 0.0, 0.0}, Vec3::UnitX());
  const VoxelVolume left = part([&](const Vec3& X) { return X.x() < middle; });
  const VoxelVolume right = part([&](const Vec3& X) { return X.x() > middle; });
  for (int level : {0, 1, 2}) {
    const auto model_of = [&](const VoxelVolume& volume) {
      return std::make_unique<ElasticModel>(volume, level, std::vector<Material>{soft(0.45)}, GetParam(),
                                            Kinematics::kCorotational);
    };
    const auto both = model_of(cut), a = model_of(left), b = model_of(right);
    const NodeField x = settle(*both), xa = settle(*a), xb = settle(*b);
    double error = 0.0;
    for (const Vec3& voxel : {Vec3(6, 5, 5), Vec3(6, 0, 5), Vec3(1, 3, 3), Vec3(7, 5, 5), Vec3(12, 0, 5)}) {
      const Vec3 X = 0.01 * (voxel + Vec3::Constant(0.5));
      const bool is_left = X.x() < middle;
      const auto alone = is_left ? corners_at(left, a->mesh(), xa, X) : corners_at(right, b->mesh(), xb, X);
      error = std::max(error, (corners_at(cut, both->mesh(), x, X) - alone).cwiseAbs().maxCoeff() / 0.12);
    }
    EXPECT_GT((x - both->mesh().rest()).cwiseAbs().maxCoeff(), 1e-4);
    record.at_most(kind() + ", level " + std::to_string(level), 1e-6, error);
  }
}

}  // namespace
}  // namespace cfem_cutting
