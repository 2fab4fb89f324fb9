#include <Eigen/LU>
#include <cmath>

#include "elasticity/specimens.h"
#include "record.h"

namespace cfem_cutting {
namespace {

/// A square beam along its own x, gripped over its first part; lengths in m, voxels have edges of 1 m.
struct Beam {
  int level;
  int across;  // voxels
  double grip() const { return across; }
  double length() const { return 5.0 * across; }  // beyond the grip
};

Material stiff() {
  Material material = soft(0.45);
  material.young_modulus = 1e6;
  return material;
}

Embedding embed_near(const VoxelVolume& volume, const CompositeMesh& mesh, const Vec3& X) {
  int nearest = volume.find(volume.lattice().voxel_at(X));
  for (int v = 0; nearest < 0 && v < static_cast<int>(volume.voxels().size()); ++v)
    if ((volume.centre(v) - X).cwiseAbs().maxCoeff() < 1.5) nearest = v;
  return mesh.embed(nearest, X);
}

/// 8 × 8 points of the section at a distance s from the grip, in the lattice.
std::vector<Vec3> section_points(const Beam& beam, const Pose& X_TS, double s) {
  std::vector<Vec3> points;
  const double apart = beam.across / 8.0;
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 8; ++k)
      points.push_back(X_TS * Vec3(beam.grip() + s, (j + 0.5) * apart, (k + 0.5) * apart));
  return points;
}

/// Best-fit motion of a section: mean deflection (m), and its slope along the axis.
struct Section {
  double deflection = 0.0, slope = 0.0;
};
Section measure(const Beam& beam, const VoxelVolume& volume, const CompositeMesh& mesh, const Pose& X_TS,
                double s, const NodeField& u) {
  Section section;
  double moment = 0.0;
  for (const Vec3& X : section_points(beam, X_TS, s)) {
    const Vec3 moved = X_TS.linear().transpose() * embed_near(volume, mesh, X).apply(u);
    const double z = (X_TS.inverse() * X).z() - 0.5 * beam.across;
    section.deflection += moved.z() / 64.0;
    section.slope -= moved.x() * z;
    moment += z * z;
  }
  section.slope /= moment;
  return section;
}

std::vector<PointConstraint> end_shear(const Beam& beam, const VoxelVolume& volume, const CompositeMesh& mesh,
                                       const Pose& X_TS) {
  std::vector<PointConstraint> load;
  for (const Vec3& X : section_points(beam, X_TS, beam.length() - 1e-6)) {
    PointConstraint c;
    c.at = embed_near(volume, mesh, X);
    c.direction = X_TS.linear().col(2);
    c.multiplier = 1.0 / 64.0;
    load.push_back(c);
  }
  return load;
}

struct Bent {
  double deflection;  // m, of the end relative to the section beside the grip
  double mass_error;  // relative
};

/// Bends a beam that X_TS places in the lattice. The end's deflection is that from the motion of the section
/// at the grip, so that it does not matter where in a voxel the grip ends.
Bent bend(const Beam& beam, const Pose& X_TS) {
  const Vec3 size(beam.grip() + beam.length(), beam.across, beam.across);
  const VoxelVolume volume = VoxelVolume::sample(*make_box(size, X_TS), Vec3::Ones());
  const ElasticModel model(volume, beam.level, {stiff()}, ElementKind::kIncompatibleModes,
                           Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  const HeldNodes held =
      hold_where(mesh, [&](const Vec3& X) { return (X_TS.inverse() * X).x() < 0.5 * beam.grip(); });
  SolverOptions options = precise();
  options.tolerance = 1e-7;
  NodeField x = mesh.rest();
  Integrator integrator(options);
  EXPECT_TRUE(
      integrator.equilibrate(model, x, Vec3::Zero(), held, end_shear(beam, volume, mesh, X_TS)).converged);
  const NodeField u = x - mesh.rest();
  const Section root = measure(beam, volume, mesh, X_TS, 0.0, u);
  const Section end = measure(beam, volume, mesh, X_TS, beam.length() - 1e-6, u);
  return {end.deflection - root.deflection - beam.length() * root.slope,
          model.total_mass() / (stiff().density * size.prod()) - 1.0};
}

Pose turned(double degrees, const Vec3& axis) {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis.normalized()));
  return pose;
}

std::string describe(const Beam& beam) {
  return std::to_string(beam.across) + " voxels across, level " + std::to_string(beam.level);
}

void PrintTo(const Beam& beam, std::ostream* stream) { *stream << describe(beam); }

class Boundary : public testing::TestWithParam<Beam> {};
INSTANTIATE_TEST_SUITE_P(EightElementsAcross, Boundary, testing::Values(Beam{0, 8}, Beam{1, 16}));

TEST_P(Boundary, ShiftedCantilever) {
  Record record("Cantilever shifted in the lattice, " + describe(GetParam()), "the aligned one");
  const double aligned = bend(GetParam(), Pose::Identity()).deflection;
  for (double shift : {0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9}) {
    Pose pose = Pose::Identity();
    pose.translate(shift * Vec3(1.0, 1.0, 1.0));
    const Bent bent = bend(GetParam(), pose);
    const std::string name = "by " + testing::PrintToString(shift) + " voxels, ";
    record.relative(name + "deflection", 1.0, bent.deflection / aligned, 0.03);
    record.at_most(name + "error of the mass", 0.005, bent.mass_error);
  }
}

TEST_P(Boundary, RotatedCantilever) {
  Record record("Cantilever turned in the lattice, " + describe(GetParam()), "the aligned one");
  const double aligned = bend(GetParam(), Pose::Identity()).deflection;
  for (double degrees : {5.0, 15.0, 30.0, 45.0}) {
    for (const Vec3& axis : {Vec3(0.0, 1.0, 0.0), Vec3(1.0, 2.0, -0.5)}) {
      const Bent bent = bend(GetParam(), turned(degrees, axis));
      const std::string name = "by " + testing::PrintToString(degrees) + "° about " +
                               (axis.x() == 0.0 ? "y, " : "a slanted axis, ");
      record.relative(name + "deflection", 1.0, bent.deflection / aligned, 0.05);
      record.at_most(name + "error of the mass", 0.005, bent.mass_error);
    }
  }
}

/// Where fewer elements lie across, they themselves bend less well when turned.
TEST(CoarseBoundary, FewElementsAcross) {
  for (const Beam& beam : {Beam{1, 8}, Beam{2, 8}}) {
    Record record("Cantilever turned in the lattice, " + describe(beam), "the aligned one");
    const double aligned = bend(beam, Pose::Identity()).deflection;
    for (double degrees : {15.0, 30.0, 45.0})
      record.note("by " + testing::PrintToString(degrees) + "° about y, deflection",
                  bend(beam, turned(degrees, Vec3::UnitY())).deflection / aligned);
  }
}

}  // namespace
}  // namespace cfem_cutting
