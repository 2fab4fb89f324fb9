#include "cfem_cutting/contact/edge_contact.h"

#include <gtest/gtest.h>

#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

constexpr double kSpacing = 0.002;    // m
constexpr double kStiffness = 800.0;  // N/m

/// A box of one voxel column, with one point on its top held by an edge along y that cuts towards −z.
class EdgeContactTest : public testing::Test {
 protected:
  EdgeContactTest()
      : volume(
            VoxelVolume::sample(*make_box(Vec3(0.02, 0.02, 0.02), Pose::Identity()), Vec3::Constant(0.01))),
        mesh(volume, 0),
        x(mesh.rest()),
        contact(kSpacing, kStiffness, 0.5) {
    EdgeContactPoint point;
    point.X = Vec3(0.01, 0.01, 0.0199);
    point.voxel = volume.find(volume.lattice().voxel_at(Vec3(0.005, 0.005, 0.015)));
    contact.bind(point);
  }

  Front front_at(double z, double y = 0.0) const {
    return {{Vec3(0.01, y, z), Vec3(0.01, y + 0.02, z)}, Vec3::UnitZ()};
  }
  void follow(double z, const Pose& motion = Pose::Identity()) {
    contact.follow(front_at(z), motion, mesh, x);
  }

  VoxelVolume volume;
  CompositeMesh mesh;
  NodeField x;
  EdgeContact contact;
};

TEST_F(EdgeContactTest, is_inactive_until_the_blade_reaches_the_point) {
  follow(0.0200);
  EXPECT_FALSE(contact.pushes());
  EXPECT_TRUE(contact.constraints(mesh, x, 0.01).empty());
  follow(0.0198);
  EXPECT_TRUE(contact.pushes());
}

TEST_F(EdgeContactTest, pushes_the_tissue_the_way_the_blade_cuts) {
  follow(0.0189);
  contact.take_forces(contact.constraints(mesh, x, 0.01), x);
  const Vec3 force = contact.points().front().force;
  EXPECT_NEAR(force.z(), -kStiffness * 0.001, 1e-9);
  EXPECT_NEAR(force.x(), 0.0, 1e-12);
}

TEST_F(EdgeContactTest, multipliers_add_up_until_the_gap_closes) {
  follow(0.0189);
  contact.take_forces(contact.constraints(mesh, x, 0.01), x);
  follow(0.0189);
  contact.take_forces(contact.constraints(mesh, x, 0.01), x);
  EXPECT_NEAR(contact.points().front().force.z(), -2.0 * kStiffness * 0.001, 1e-9);
}

TEST_F(EdgeContactTest, never_pulls) {
  follow(0.0198);
  ASSERT_TRUE(contact.pushes());
  follow(0.0210);
  contact.take_forces(contact.constraints(mesh, x, 0.01), x);
  EXPECT_FALSE(contact.pushes());
  EXPECT_EQ(contact.points().front().force, Vec3::Zero());
}

TEST_F(EdgeContactTest, friction_is_bounded_by_coulomb_and_follows_the_slip) {
  follow(0.0189);
  contact.take_forces(contact.constraints(mesh, x, 0.01), x);
  const double normal = contact.points().front().force.norm();
  follow(0.0189, Pose(Eigen::Translation3d(0, 0.0005, 0)));
  const auto rows = contact.constraints(mesh, x, 0.01);
  EXPECT_NEAR(rows[2].force(x), 0.5 * normal, 1e-9);
}

TEST_F(EdgeContactTest, lets_go_of_points_beyond_the_edges_ends) {
  contact.follow(front_at(0.0189, 0.0095), Pose::Identity(), mesh, x);
  EXPECT_FALSE(contact.empty());
  contact.follow(front_at(0.0189, 0.0115), Pose::Identity(), mesh, x);
  EXPECT_TRUE(contact.empty());
}

TEST_F(EdgeContactTest, covers_its_neighbourhood) {
  follow(0.0189);
  EXPECT_TRUE(contact.covers(0.01 + 0.7 * kSpacing));
  EXPECT_FALSE(contact.covers(0.01 + 0.8 * kSpacing));
}

}  // namespace
}  // namespace cfem_cutting
