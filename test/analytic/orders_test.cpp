#include <array>
#include <cmath>

#include "direct_problem.h"
#include "elasticity/specimens.h"
#include "element_kinds.h"
#include "record.h"

namespace cfem_cutting {
namespace {

const Vec3 kAmplitude(0.1, 0.05, -0.07);  // m

/// Manufactured solution on the unit cube: u = a sin πx sin πy sin πz + an affine part.
struct Manufactured {
  double lambda, mu;  // Pa
  static Mat3 affine() { return (Mat3() << 0.02, 0.01, 0.0, -0.01, 0.0, 0.03, 0.01, 0.0, -0.02).finished(); }

  static Vec3 displacement(const Vec3& X) {
    const Eigen::Array3d s = (M_PI * X.array()).sin();
    return kAmplitude * s.prod() + affine() * X;
  }

  static Mat3 gradient(const Vec3& X) {
    const Eigen::Array3d s = (M_PI * X.array()).sin(), c = (M_PI * X.array()).cos();
    return M_PI * kAmplitude *
               Eigen::RowVector3d(c[0] * s[1] * s[2], s[0] * c[1] * s[2], s[0] * s[1] * c[2]) +
           affine();
  }

  /// −(λ + μ) ∇(∇·u) − μ Δu, N/m³.
  Vec3 body_force(const Vec3& X) const {
    const Eigen::Array3d s = (M_PI * X.array()).sin(), c = (M_PI * X.array()).cos();
    Mat3 second;  // ∂ᵢ∂ⱼ of the product of sines, over π²
    second << -s.prod(), c[0] * c[1] * s[2], c[0] * s[1] * c[2],  //
        c[0] * c[1] * s[2], -s.prod(), s[0] * c[1] * c[2],        //
        c[0] * s[1] * c[2], s[0] * c[1] * c[2], -s.prod();
    return M_PI * M_PI * (3.0 * mu * s.prod() * kAmplitude - (lambda + mu) * second * kAmplitude);
  }
};

struct Sample {
  Vec3 t;         // in the element, [0, 1]³
  double weight;  // of its volume
};

std::vector<Sample> gauss_points() {  // 3 × 3 × 3
  const std::array<double, 3> t{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
      w{5. / 18, 8. / 18, 5. / 18};
  std::vector<Sample> samples;
  for (int n = 0; n < 27; ++n)
    samples.push_back({{t[n % 3], t[n / 3 % 3], t[n / 9]}, w[n % 3] * w[n / 3 % 3] * w[n / 9]});
  return samples;
}

struct Errors {
  double L2 = 0.0, H1 = 0.0;
};

Errors errors(const CompositeMesh& mesh, const NodeField& u) {
  Errors squared;
  const double h = mesh.block_size().x(), volume = h * h * h;
  for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e) {
    for (const Sample& sample : gauss_points()) {
      const Vec3 X = mesh.block_corner(e) + h * sample.t;
      squared.L2 += sample.weight * volume *
                    (mesh.embed_in_element(e, X).apply(u) - Manufactured::displacement(X)).squaredNorm();
      Mat3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 low = X, high = X;  // trilinear: differences over the element are exact
        low[axis] = mesh.block_corner(e)[axis];
        high[axis] = low[axis] + h;
        gradient.col(axis) =
            (mesh.embed_in_element(e, high).apply(u) - mesh.embed_in_element(e, low).apply(u)) / h;
      }
      squared.H1 += sample.weight * volume * (gradient - Manufactured::gradient(X)).squaredNorm();
    }
  }
  return {std::sqrt(squared.L2), std::sqrt(squared.H1)};
}

Errors solve_manufactured(int n, ElementKind kind) {
  const Material material = soft(0.3);
  const double mu = material.young_modulus / 2.6, lambda = 1.5 * mu;
  const ElasticModel model(box_volume({1.0, 1.0, 1.0}, 1.0 / n), 0, {material}, kind, Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  DirectProblem problem(model);
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Vec3 X = mesh.rest().col(node);
    if (X.minCoeff() > 1e-9 && X.maxCoeff() < 1.0 - 1e-9) continue;
    for (int axis = 0; axis < 3; ++axis) problem.hold(node, axis, Manufactured::displacement(X)[axis]);
  }
  NodeField loads = NodeField::Zero(3, mesh.node_count());
  const double h = 1.0 / n;
  for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e) {
    for (const Sample& sample : gauss_points()) {
      const Vec3 X = mesh.block_corner(e) + h * sample.t;
      const Vec3 force = sample.weight * h * h * h * Manufactured{lambda, mu}.body_force(X);
      const Embedding at = mesh.embed_in_element(e, X);
      for (int i = 0; i < 8; ++i) loads.col(at.nodes[i]) += at.weights[i] * force;
    }
  }
  return errors(mesh, problem.solve(loads));
}

class Orders : public testing::TestWithParam<ElementKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, Orders,
                         testing::Values(ElementKind::kTrilinear, ElementKind::kIncompatibleModes));

TEST_P(Orders, Displacement) {
  const std::string kind = name_of(GetParam());
  Record record("Orders of convergence", "manufactured solution on the unit cube");
  std::vector<Errors> found;
  for (int n : {3, 6, 12}) {
    found.push_back(solve_manufactured(n, GetParam()));
    record.point("orders", kind + ", L2", 1.0 / n, found.back().L2);
    record.point("orders", kind + ", H1", 1.0 / n, found.back().H1);
  }
  record.absolute(kind + ", L2", 2.0, std::log2(found[1].L2 / found[2].L2), 0.1);
  record.absolute(kind + ", H1", 1.0, std::log2(found[1].H1 / found[2].H1), 0.05);
}

/// Positions of a co-rotational block at the end of a swing, with steps of dt.
NodeField swing(double dt) {
  const ElasticModel model(box_volume({0.06, 0.02, 0.02}, 0.01), 0, {soft(0.45)},
                           ElementKind::kIncompatibleModes, Kinematics::kCorotational);
  const HeldNodes held = hold_where(model.mesh(), [](const Vec3& X) { return X.x() < 1e-9; });
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  Integrator integrator(precise());
  const int steps = static_cast<int>(std::lround(0.08 / dt));
  for (int i = 0; i < steps; ++i) integrator.step(model, state, dt, {0.0, 2.0, -9.81}, held, {});
  return state.x;
}

TEST(Orders, ImplicitEuler) {
  Record record("Orders of convergence", "differences of halved steps");
  std::vector<NodeField> x;
  for (int halvings = 0; halvings < 5; ++halvings) x.push_back(swing(0.001 / (1 << halvings)));
  std::vector<double> change;
  for (int k = 0; k < 4; ++k) {
    change.push_back((x[k] - x[k + 1]).norm());
    record.point("time", "implicit Euler", 1.0 / (1 << k), change.back());
  }
  record.absolute("implicit Euler in dt", 1.0, std::log2(change[2] / change[3]), 0.05);
}

}  // namespace
}  // namespace cfem_cutting
