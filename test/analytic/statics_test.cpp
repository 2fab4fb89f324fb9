#include <cmath>

#include "direct_problem.h"
#include "elasticity/specimens.h"
#include "element_kinds.h"
#include "record.h"

namespace cfem_cutting {
namespace {

/// u(z) = ρ g (L z − z²/2) / E.
TEST(Statics, GravityColumn) {
  const ElasticModel model(box_volume({0.02, 0.02, 0.1}, 0.01), 0, {soft(0.0)}, ElementKind::kTrilinear,
                           Kinematics::kLinear);
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.z() < 1e-9; });
  NodeField x = model.mesh().rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, {0, 0, -9.81}, held, {}).converged);
  double error = 0.0;
  for (int n = 0; n < model.mesh().node_count(); ++n) {
    const double z = model.mesh().rest()(2, n);
    error = std::max(error, std::abs(x(2, n) - z + 1060.0 * 9.81 * (0.1 * z - 0.5 * z * z) / 1e4));
  }
  Record record("Gravity column, L = 0.1 m, E = 10 kPa, ρ = 1060 kg/m³, ν = 0",
                "closed form, ρg(Lz − z²/2)/E");
  record.absolute("tip, mm", -5.1993, 1e3 * (x.row(2).maxCoeff() - 0.1), 5e-5);
  record.at_most("largest error of any node, m", 1e-12, error);
}

/// J of a square bar of side 1, from the energy ½ μ J θ² of a length under the twist θ: the sections turn
/// about the axis at both ends and are free to warp.
double torsion_constant(int across, ElementKind kind) {
  const double twist = 0.1;  // rad/m
  const VoxelVolume volume = VoxelVolume::sample(*make_box({1.0, 1.0, 0.25}, Pose::Identity()),
                                                 Vec3(1.0 / across, 1.0 / across, 0.25));
  const ElasticModel model(volume, 0, {soft(0.3)}, kind, Kinematics::kLinear);
  const NodeField& X = model.mesh().rest();
  DirectProblem problem(model);
  for (int n = 0; n < model.mesh().node_count(); ++n) {
    problem.hold(n, 0, -twist * X(2, n) * (X(1, n) - 0.5));
    problem.hold(n, 1, twist * X(2, n) * (X(0, n) - 0.5));
    const bool axis = (X.col(n).head<2>() - Eigen::Vector2d(0.5, 0.5)).norm() < 1e-9;
    if (axis && X(2, n) < 1e-9) problem.hold(n, 2, 0.0);  // does not drift
  }
  const NodeField u = problem.solve(NodeField::Zero(3, X.cols()));
  const double mu = soft(0.3).young_modulus / 2.6;
  return model.energy(X + u) / (0.5 * mu * twist * twist * 0.25);
}

TEST(Statics, Torsion) {
  Record record("Torsion of a square bar, J/a⁴", "independent hexahedra; exact .140577 (Saint-Venant)");
  const std::array<double, 4> table{.1667, .1479, .1425, .1411};
  for (int k = 0; k < 4; ++k) {
    const int across = 2 << k;
    const double J = torsion_constant(across, ElementKind::kTrilinear);
    record.absolute(std::to_string(across) + " across, trilinear", table[k], J, 6e-5);
    record.point("torsion", "trilinear", across, J / .140577 - 1.0);
    const double modes = torsion_constant(across, ElementKind::kIncompatibleModes);
    record.note(std::to_string(across) + " across, incompatible modes", modes);
    record.point("torsion", "incompatible modes", across, std::abs(modes / .140577 - 1.0));
  }
}

/// Energy of x = F X over μ V; R turns by atan(γ/2) about z, so that
/// W/μ = |e|² + ½ λ/μ tr(e)², e = sym(RᵀF) − I.
double simple_shear_closed_form(double gamma, double nu) {
  const double theta = std::atan(0.5 * gamma), c = std::cos(theta), s = std::sin(theta);
  Eigen::Matrix2d R, F;
  R << c, s, -s, c;
  F << 1.0, gamma, 0.0, 1.0;
  const Eigen::Matrix2d U = R.transpose() * F;
  const Eigen::Matrix2d e = 0.5 * (U + U.transpose()) - Eigen::Matrix2d::Identity();
  return e.squaredNorm() + nu / (1.0 - 2.0 * nu) * std::pow(e.trace(), 2);
}

TEST(Statics, CorotationalSimpleShear) {
  const double nu = 0.45, mu = soft(nu).young_modulus / (2.0 * (1.0 + nu));
  Record record("Co-rotational simple shear, W/μ at ν = 0.45", "closed form, θ = atan(γ/2)");
  const std::array<double, 3> gammas{0.1, 0.5, 1.0}, table{.0050312, .143944, .778640};
  for (ElementKind kind : {ElementKind::kTrilinear, ElementKind::kIncompatibleModes}) {
    const ElasticModel model(tilted_volume({0.5, 0.4, 0.3}, 0.1), 1, {soft(nu)}, kind,
                             Kinematics::kCorotational);
    const double filled = model.total_mass() / soft(nu).density;
    for (int k = 0; k < 3; ++k) {
      Mat3 F = Mat3::Identity();
      F(0, 1) = gammas[k];
      const double W = model.energy(F * model.mesh().rest()) / (mu * filled);
      const std::string name =
          "γ = " + testing::PrintToString(gammas[k]) + ", " + name_of(kind) + ", tilted block";
      record.relative(name, table[k], W, 1e-5);
      EXPECT_NEAR(W, simple_shear_closed_form(gammas[k], nu), 1e-10 * W);
    }
  }
}

TEST(Statics, RigidRotation) {
  Record record("Rigid rotation, largest nodal force over E h²", "frame indifference");
  VoxelVolume volume = tilted_volume({0.05, 0.04, 0.03}, 0.005);
  sever_plane(volume, {0.02, 0.02, 0.02}, Vec3(1.0, 0.4, 0.2).normalized());
  for (double degrees : {10.0, 90.0, 179.0}) {
    const Mat3 R =
        Eigen::AngleAxisd(degrees * M_PI / 180.0, Vec3(0.3, -1.0, 0.5).normalized()).toRotationMatrix();
    for (int level : {0, 1, 2}) {
      const ElasticModel model(volume, level, {soft(0.45)}, ElementKind::kIncompatibleModes,
                               Kinematics::kCorotational);
      const double scale = soft(0.45).young_modulus * std::pow(model.mesh().block_size().mean(), 2);
      record.at_most(
          std::to_string(static_cast<int>(degrees)) + "°, cut tilted block, level " + std::to_string(level),
          1e-12, model.forces(R * model.mesh().rest()).cwiseAbs().maxCoeff() / scale);
    }
  }
}

/// Strip of height H whose edges are pulled apart by δ, cracked along its middle: G = ½ (λ+2μ) δ²/H, from the
/// energy that one more row of severed links sets free.
TEST(Statics, ClampedStrip) {
  const int rows = 16;
  const double height = 1.0, h = height / rows, pull = 0.01;
  const Material material = soft(0.3);
  const double E = material.young_modulus, nu = material.poisson_ratio;
  const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = E / (2.0 * (1.0 + nu));
  std::vector<double> energies;
  for (double crack : {2.0, 2.0 + h}) {
    VoxelVolume volume = box_volume({5.0, h, height}, h);
    sever_plane(volume, {0.0, 0.0, 0.5 * height}, Vec3::UnitZ(),
                [&](const Vec3& X) { return X.x() < crack; });
    const ElasticModel model(volume, 0, {material}, ElementKind::kTrilinear, Kinematics::kLinear);
    const NodeField& X = model.mesh().rest();
    DirectProblem problem(model);
    for (int n = 0; n < model.mesh().node_count(); ++n) {
      problem.hold(n, 1, 0.0);
      if (X(2, n) > 1e-9 && X(2, n) < height - 1e-9) continue;
      problem.hold(n, 0, 0.0);
      problem.hold(n, 2, X(2, n) > 0.5 * height ? pull : 0.0);
    }
    energies.push_back(model.energy(X + problem.solve(NodeField::Zero(3, X.cols()))));
  }
  Record record("Clamped strip, plane strain, G over ½ (λ+2μ) δ²/H", "closed form");
  record.relative("trilinear, 16 rows", 1.0,
                  (energies[0] - energies[1]) / (h * h) / (0.5 * (lambda + 2.0 * mu) * pull * pull / height),
                  0.002);
}

}  // namespace
}  // namespace cfem_cutting
