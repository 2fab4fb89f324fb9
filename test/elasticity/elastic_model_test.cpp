#include "cfem_cutting/elasticity/elastic_model.h"

#include <gtest/gtest.h>

#include "cfem_cutting/geometry/errors.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

const std::vector<Material> kLiver{soft(0.45)};

VoxelVolume cut_tilted_volume() {
  VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
  sever_plane(volume, {0.02, 0.02, 0.02}, Vec3(1.0, 0.4, 0.2).normalized());
  return volume;
}

double stiffness_scale(const ElasticModel& model) {  // E h², N
  return kLiver[0].young_modulus * std::pow(model.mesh().block_size().mean(), 2);
}

class ModelOfAnyKind : public testing::TestWithParam<std::tuple<ElementKind, int>> {
 protected:
  ElasticModel model(const VoxelVolume& volume, Kinematics kinematics) const {
    return {volume, std::get<1>(GetParam()), kLiver, std::get<0>(GetParam()), kinematics};
  }
};

INSTANTIATE_TEST_SUITE_P(KindsAndLevels, ModelOfAnyKind,
                         testing::Combine(testing::Values(ElementKind::kIncompatibleModes,
                                                          ElementKind::kTrilinear),
                                          testing::Values(0, 1, 2)));

TEST_P(ModelOfAnyKind, RigidMotionMakesNoForces) {
  const ElasticModel m = model(cut_tilted_volume(), Kinematics::kCorotational);
  for (double angle : {0.1, 1.5, 3.1}) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3(0.3, -1.0, 0.5).normalized()).toRotationMatrix();
    const NodeField x = (R * m.mesh().rest()).colwise() + Vec3(1.0, -2.0, 3.0) * 0.1;
    EXPECT_LT(m.forces(x).cwiseAbs().maxCoeff(), 1e-12 * stiffness_scale(m));
  }
}

TEST_P(ModelOfAnyKind, ForceIsMinusTheEnergyDerivative) {
  const ElasticModel m = model(cut_tilted_volume(), Kinematics::kCorotational);
  const double h = m.mesh().block_size().mean();
  const NodeField x = m.mesh().rest() + random_displacement(m.mesh().node_count(), 0.15 * h, 7);
  const NodeField f = m.forces(x);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const NodeField direction = random_displacement(m.mesh().node_count(), 1.0, seed);
    const double epsilon = 1e-5 * h;
    const double slope =
        (m.energy(x + epsilon * direction) - m.energy(x - epsilon * direction)) / (2.0 * epsilon);
    const double expected = -f.cwiseProduct(direction).sum();
    EXPECT_NEAR(slope, expected, 1e-6 * f.norm() * direction.norm()) << "seed " << seed;
  }
}

/// Constant stress does no net work on the modes of any element (Taylor, Beresford and Wilson 1976): an
/// affine displacement has the energy ½ ε:C:ε V of the filled volume V.
TEST_P(ModelOfAnyKind, AffineFieldHasTheExactEnergy) {
  const VoxelVolume volume = cut_tilted_volume();
  const ElasticModel m = model(volume, Kinematics::kLinear);
  const Mat3 G = (Mat3() << 0.01, 0.02, -0.01, 0.005, -0.02, 0.03, 0.0, 0.01, 0.015).finished();
  const Mat3 strain = 0.5 * (G + G.transpose());
  const double E = kLiver[0].young_modulus, nu = kLiver[0].poisson_ratio;
  const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = E / (2.0 * (1.0 + nu));
  double filled = 0.0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) filled += volume.filled_volume(v);
  const double expected = filled * (0.5 * lambda * std::pow(strain.trace(), 2) + mu * strain.squaredNorm());
  const NodeField x = m.mesh().rest() + G * m.mesh().rest();
  EXPECT_NEAR(m.energy(x), expected, 1e-10 * expected);
}

/// The force on a node of one element in a constant stress field is −∫ σ ∇N dV over its own filled volume,
/// with or without modes.
TEST(ElasticModel, ModesFeelNoConstantStress) {
  const VoxelVolume volume = cut_tilted_volume();
  const ElasticModel with(volume, 2, kLiver, ElementKind::kIncompatibleModes, Kinematics::kLinear);
  const ElasticModel without(volume, 2, kLiver, ElementKind::kTrilinear, Kinematics::kLinear);
  const Mat3 G = (Mat3() << 0.1, 0.2, -0.1, 0.05, -0.2, 0.3, 0.0, 0.1, 0.15).finished();
  for (int e = 0; e < static_cast<int>(with.mesh().elements().size()); ++e) {
    Eigen::Matrix<double, 24, 1> u;
    for (int n = 0; n < 8; ++n)
      u.segment<3>(3 * n) =
          G * (with.mesh().rest().col(with.mesh().elements()[e].nodes[n]) - with.mesh().block_corner(e));
    const double scale = with.stiffness(e).cwiseAbs().maxCoeff() * u.norm();
    EXPECT_LT(((with.stiffness(e) - without.stiffness(e)) * u).norm(), 1e-12 * scale) << "element " << e;
  }
}

TEST_P(ModelOfAnyKind, CutsKeepTheMass) {
  VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
  ElasticModel m = model(volume, Kinematics::kCorotational);
  const double before = m.total_mass();
  double by_voxels = 0.0;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v)
    by_voxels += kLiver.front().density * volume.filled_volume(v);
  EXPECT_NEAR(before, by_voxels, 1e-12 * before);
  sever_plane(volume, {0.02, 0.02, 0.02}, Vec3(1.0, 0.4, 0.2).normalized());
  m.update(volume);
  EXPECT_NEAR(m.total_mass(), before, 1e-12 * before);
  EXPECT_GT(m.mass().minCoeff(), 0.0);
}

TEST_P(ModelOfAnyKind, UpdateEqualsANewModel) {
  VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
  ElasticModel updated = model(volume, Kinematics::kCorotational);
  sever_plane(volume, {0.02, 0.02, 0.02}, Vec3(1.0, 0.4, 0.2).normalized());
  updated.update(volume);
  const ElasticModel fresh = model(volume, Kinematics::kCorotational);
  ASSERT_EQ(updated.mesh().node_count(), fresh.mesh().node_count());
  const NodeField x = fresh.mesh().rest() + random_displacement(fresh.mesh().node_count(), 1e-3, 3);
  EXPECT_EQ(updated.forces(x), fresh.forces(x));
}

/// A block of full voxels is one trilinear hexahedron: level 1 equals level 0 on twice the spacing.
TEST(ElasticModel, UncutCompositeEqualsThePlainMesh) {
  for (ElementKind kind : {ElementKind::kIncompatibleModes, ElementKind::kTrilinear}) {
    const ElasticModel composite(box_volume({0.04, 0.04, 0.08}, 0.01), 1, kLiver, kind,
                                 Kinematics::kCorotational);
    const ElasticModel plain(box_volume({0.04, 0.04, 0.08}, 0.02), 0, kLiver, kind,
                             Kinematics::kCorotational);
    ASSERT_LT((composite.mesh().rest() - plain.mesh().rest()).norm(), 1e-14);
    const NodeField x = plain.mesh().rest() + random_displacement(plain.mesh().node_count(), 2e-3, 5);
    EXPECT_LT((composite.forces(x) - plain.forces(x)).norm(), 1e-10 * plain.forces(x).norm());
    EXPECT_LT((composite.mass() - plain.mass()).norm(), 1e-10 * plain.mass().norm());
  }
}

/// The sum of voxel integrals over a partly cut block must be that of its components.
TEST(ElasticModel, ComponentsOfABlockAddUpToTheBlock) {
  const VoxelVolume whole = box_volume({0.02, 0.02, 0.02}, 0.01);
  VoxelVolume cut = whole;
  sever_plane(cut, {0.01, 0.0, 0.0}, Vec3::UnitX());
  const ElasticModel one(whole, 1, kLiver, ElementKind::kTrilinear, Kinematics::kLinear);
  const ElasticModel two(cut, 1, kLiver, ElementKind::kTrilinear, Kinematics::kLinear);
  ASSERT_EQ(two.mesh().elements().size(), 2u);
  const ElementMatrix sum = two.stiffness(0) + two.stiffness(1);
  const double stabilised = 1e-3;  // of the hourglass part
  EXPECT_LT((sum - one.stiffness(0)).norm(), stabilised * one.stiffness(0).norm());
}

TEST(ElasticModel, InvertedElementsAreReportedAndFinite) {
  const ElasticModel m(box_volume({0.02, 0.02, 0.02}, 0.01), 0, kLiver, ElementKind::kIncompatibleModes,
                       Kinematics::kCorotational);
  NodeField x = m.mesh().rest();
  EXPECT_EQ(m.respond(x).inverted, 0);
  x.row(0) *= -0.5;  // mirrored
  const ElasticResponse mirrored = m.respond(x);
  for (const Mat3& R : mirrored.rotations) EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_EQ(mirrored.inverted, 8);
  EXPECT_TRUE(mirrored.forces.allFinite());
  x.setZero();  // a point
  EXPECT_EQ(m.respond(x).inverted, 8);
  EXPECT_TRUE(m.forces(x).allFinite());
}

TEST(ElasticModel, RefusesTissueWithoutMaterial) {
  std::vector<Material> materials{soft(0.3)};
  materials[0].label = 7;
  EXPECT_THROW(ElasticModel(box_volume({0.02, 0.02, 0.02}, 0.01), 0, materials, ElementKind::kTrilinear,
                            Kinematics::kLinear),
               ConfigError);
}

}  // namespace
}  // namespace cfem_cutting
