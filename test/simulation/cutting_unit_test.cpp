#include "cfem_cutting/simulation/cutting_unit.h"

#include <gtest/gtest.h>

#include "elasticity/specimens.h"

namespace cfem_cutting {
namespace {

constexpr double kVoxel = 0.004;         // m
constexpr double kBlock = 2.0 * kVoxel;  // m
const Vec3 kPush(0, 0, -1);

/// A bar whose links across x = 0.032 wait, in a column from z = 0.002 (link 0) upwards.
class CuttingUnitOfABar : public testing::Test {
 protected:
  CuttingUnitOfABar() {
    for (int k = 0; k < 8; ++k) {
      const int voxel = volume.find(volume.lattice().voxel_at(Vec3(0.03, 0.002, height(k))));
      column.push_back({{voxel, 0}, {Vec3(0.032, 0.002, height(k)), Vec3::UnitX()}});
    }
    unit.collect(column);
  }
  static double height(int k) { return (k + 0.5) * kVoxel; }

  /// With the front at a height.
  void measure(double z, const NodeField& x) {
    const OffsetField offsets(volume, pieces, mesh, floating, mesh.rest(), x);
    unit.measure(volume, offsets, {{Vec3(0.032, 0.0, z), Vec3(0.032, 0.016, z)}}, kPush, kBlock);
  }
  void measure(double z) { measure(z, mesh.rest()); }

  VoxelVolume volume = box_volume({0.064, 0.016, 0.032}, kVoxel);
  CompositeMesh mesh{volume, 1};
  Pieces pieces = find_pieces(volume);
  std::vector<char> floating = std::vector<char>(mesh.node_count(), 0);
  std::vector<Crossing> column;
  CuttingUnit unit;
};

TEST_F(CuttingUnitOfABar, collects_a_link_once) {
  unit.collect({column[3], column[5]});
  EXPECT_EQ(unit.candidates().size(), column.size());
}

TEST_F(CuttingUnitOfABar, knows_how_far_the_front_has_passed_a_link) {
  measure(0.011);
  EXPECT_NEAR(unit.candidates()[5].passed_by, height(5) - 0.011, 1e-12);
  EXPECT_EQ(unit.candidates()[5].front_distance, 0.0);
  EXPECT_EQ(unit.candidates()[1].passed_by, 0.0);
  EXPECT_NEAR(unit.candidates()[1].front_distance, 0.011 - height(1), 1e-12);
}

TEST_F(CuttingUnitOfABar, drops_links_when_the_front_retreats_by_more_than_two_blocks) {
  measure(height(0) + 2.0 * kBlock);
  EXPECT_EQ(unit.candidates().size(), column.size());
  measure(height(2) + 2.0 * kBlock + 1e-6);
  ASSERT_EQ(unit.candidates().size(), column.size() - 3);
  EXPECT_EQ(unit.candidates()[0].crossing.link, column[3].link);
}

TEST_F(CuttingUnitOfABar, keeps_links_that_the_front_has_passed_however_far) {
  measure(-1.0);
  EXPECT_EQ(unit.candidates().size(), column.size());
}

TEST_F(CuttingUnitOfABar, a_link_has_the_larger_offset_of_its_ends) {
  NodeField stretched = mesh.rest();
  stretched.row(0) *= 1.1;
  measure(0.016, stretched);
  for (const Candidate& c : unit.candidates()) EXPECT_NEAR(c.offset, 0.1 * 0.034, 1e-12);
}

TEST_F(CuttingUnitOfABar, waiting_links_go_on_to_the_next_unit) {
  unit.blade_work = unit.peak_force = 1.0;
  measure(0.011);
  const std::vector<Candidate> waiting(unit.candidates().begin() + 2, unit.candidates().begin() + 5);
  unit.begin_next(waiting);
  EXPECT_EQ(unit.number, 2u);
  EXPECT_EQ(unit.blade_work + unit.peak_force, 0.0);
  ASSERT_EQ(unit.candidates().size(), 3u);
  EXPECT_EQ(unit.candidates()[0].crossing.link, column[2].link);
  unit.collect(column);
  EXPECT_EQ(unit.candidates().size(), column.size());
}

TEST_F(CuttingUnitOfABar, all_are_passed_once_the_front_has_come_out_and_none_wait_after_a_drop) {
  unit.leave_behind();
  measure(0.011);
  ASSERT_FALSE(unit.candidates().empty());
  for (const Candidate& c : unit.candidates()) EXPECT_GT(c.passed_by, 1e9);
  unit.drop();
  EXPECT_TRUE(unit.candidates().empty());
}

}  // namespace
}  // namespace cfem_cutting
