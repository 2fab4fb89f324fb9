#include <cmath>

#include "direct_problem.h"
#include "elasticity/specimens.h"
#include "record.h"

namespace cfem_cutting {
namespace {

constexpr double kLength = 10.0;  // m; the section is square, of side 1

/// Uniform shear of 1 N on the end section: constraints without stiffness act as point forces at the voxels'
/// face centres.
std::vector<PointConstraint> tip_shear(const VoxelVolume& volume, const CompositeMesh& mesh, int across) {
  std::vector<PointConstraint> load;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v) {
    const Vec3 X = volume.centre(v) + Vec3(0.5 / across, 0.0, 0.0);
    if (X.x() < kLength - 1e-9) continue;
    PointConstraint c;
    c.at = mesh.embed(v, X);
    c.direction = Vec3::UnitZ();
    c.multiplier = 1.0 / (across * across);
    load.push_back(c);
  }
  return load;
}

/// P L³/3EI + P L/(κ G A), κ = 5/6, for P = 1 N, m (Timoshenko).
double timoshenko(double nu) {
  const double E = soft(nu).young_modulus, G = E / (2.0 * (1.0 + nu));
  return std::pow(kLength, 3) / (3.0 * E / 12.0) + kLength / (5.0 / 6.0 * G);
}

/// Tip deflection over Timoshenko's.
double cantilever_ratio(int across, double nu, ElementKind kind) {
  const VoxelVolume volume = box_volume({kLength, 1.0, 1.0}, 1.0 / across);
  const ElasticModel model(volume, 0, {soft(nu)}, kind, Kinematics::kLinear);
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.x() < 1e-9; });
  const std::vector<PointConstraint> load = tip_shear(volume, model.mesh(), across);
  NodeField x = model.mesh().rest();
  Integrator integrator(precise());
  EXPECT_TRUE(integrator.equilibrate(model, x, Vec3::Zero(), held, load).converged);
  double deflection = 0.0;
  for (const PointConstraint& c : load)
    deflection += (c.at.apply(x) - c.at.apply(model.mesh().rest())).z() / load.size();
  return deflection / timoshenko(nu);
}

struct Row {
  double nu;
  std::array<double, 3> trilinear, incompatible;  // 1, 2, 4 elements across
};

void PrintTo(const Row& row, std::ostream* stream) { *stream << "nu " << row.nu; }

class Cantilever : public testing::TestWithParam<Row> {};

INSTANTIATE_TEST_SUITE_P(Table, Cantilever,
                         testing::Values(Row{0.3, {.643, .869, .957}, {.986, .987, .990}},
                                         Row{0.45, {.514, .758, .902}, {.962, .965, .976}},
                                         Row{0.49, {.407, .617, .786}, {.921, .948, .969}}));

TEST_P(Cantilever, AgreesWithTheTableOfCommonElements) {
  const Row row = GetParam();
  Record record("Cantilever, tip deflection over Timoshenko's", "CalculiX 2.20, C3D8 and C3D8I");
  const std::string nu = "ν = " + testing::PrintToString(row.nu);
  for (int refinement = 0; refinement < 3; ++refinement) {
    const int across = 1 << refinement;
    const std::string mesh = nu + ", " + std::to_string(across) + " across, ";
    const double plain = cantilever_ratio(across, row.nu, ElementKind::kTrilinear);
    record.relative(mesh + "trilinear", row.trilinear[refinement], plain, 0.005);
    const double modes = cantilever_ratio(across, row.nu, ElementKind::kIncompatibleModes);
    const double table = row.incompatible[refinement];
    record.judged(mesh + "incompatible modes", table, modes, "± 1 %, or nearer to 1",
                  std::abs(modes - table) <= 0.01 * table || std::abs(modes - 1.0) < std::abs(table - 1.0));
    record.point("cantilever", nu + ", trilinear", across, plain);
    record.point("cantilever", nu + ", incompatible modes", across, modes);
  }
}

/// β²/2π of the cantilever's modes: (β²/2π) √(EI/ρAL⁴).
TEST(Frequencies, Cantilever) {
  const double length = 60.0;  // slender: Timoshenko's terms stay below 0.4 %
  const VoxelVolume volume =
      VoxelVolume::sample(*make_box({length, 1.0, 1.0}, Pose::Identity()), Vec3(0.75, 0.5, 0.5));
  const Material material = soft(0.3);
  const ElasticModel model(volume, 0, {material}, ElementKind::kIncompatibleModes, Kinematics::kLinear);
  DirectProblem problem(model);
  for (int n : hold_where(model.mesh(), [](const Vec3& X) { return X.x() < 1e-9; }).nodes)
    for (int axis = 0; axis < 3; ++axis) problem.hold(n, axis, 0.0);
  const std::vector<double> f = problem.frequencies(6);  // each twice: two planes of bending
  Record record("Natural frequencies, Hz", "Euler and Bernoulli, β²/2π √(EI/ρAL⁴)");
  const double unit = std::sqrt(material.young_modulus / 12.0 / (material.density * std::pow(length, 4)));
  const std::array<double, 3> beta{.55959, 3.50690, 9.81942};
  for (int k = 0; k < 3; ++k)
    record.relative("cantilever, mode " + std::to_string(k + 1), beta[k] * unit, f[2 * k], 0.01);
}

/// The axial bar by its own time steps: f = √(E/ρ)/4L, measured between passages through rest.
TEST(Frequencies, AxialBar) {
  const ElasticModel model(box_volume({1.0, 0.05, 0.05}, 0.05), 0, {soft(0.0)}, ElementKind::kTrilinear,
                           Kinematics::kLinear);
  const double expected = std::sqrt(soft(0.0).young_modulus / soft(0.0).density) / 4.0;
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.x() < 1e-9; });
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  for (int n = 0; n < model.mesh().node_count(); ++n)
    state.x(0, n) += 0.01 * std::sin(0.5 * M_PI * model.mesh().rest()(0, n));
  SolverOptions options = precise();
  options.rayleigh_mass = options.rayleigh_stiffness = 0.0;
  Integrator integrator(options);
  const int tip = model.mesh().node_count() - 1;
  const double dt = 1.0 / expected / 400.0;
  std::vector<double> passages;
  for (int i = 0; passages.size() < 5; ++i) {
    const double before = state.x(0, tip) - model.mesh().rest()(0, tip);
    integrator.step(model, state, dt, Vec3::Zero(), held, {});
    const double after = state.x(0, tip) - model.mesh().rest()(0, tip);
    if ((before > 0.0) != (after > 0.0)) passages.push_back(dt * (i + before / (before - after)));
  }
  Record record("Natural frequencies, Hz", "wave equation, √(E/ρ)/4L");
  record.relative("axial bar, by time steps", expected, 2.0 / (passages.back() - passages.front()), 0.002);
}

}  // namespace
}  // namespace cfem_cutting
