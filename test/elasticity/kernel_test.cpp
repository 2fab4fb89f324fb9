// Kernels of every instruction set that this processor can run, against plain matrices.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "corotation_kernel.h"
#include "mirrored_matrix.h"
#include "packed_stiffness.h"
#include "rotation.h"

namespace cfem_cutting {
namespace {

constexpr int kNodes = 50;

constexpr MatrixForm kForms[] = {MatrixForm::kMirrored, MatrixForm::kWhole, MatrixForm::kTriangles,
                                 MatrixForm::kDeformations};

/// Columns: small rigid motions of the corners of a block.
Eigen::Matrix<double, 24, 6> rigid_motions(const Vec3& size) {
  Eigen::Matrix<double, 24, 6> motions;
  for (int n = 0; n < 8; ++n) {
    motions.block<3, 3>(3 * n, 0).setIdentity();
    for (int axis = 0; axis < 3; ++axis)
      motions.block<3, 1>(3 * n, 3 + axis) =
          Vec3::Unit(axis).cross(corner_bits(n).cast<double>().cwiseProduct(size));
  }
  return motions;
}

/// K without forces against those motions.
template <typename Motions>
ElementMatrix without(const Motions& motions, const ElementMatrix& K) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motions);
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(24, motions.cols());
  const ElementMatrix left = ElementMatrix::Identity() - basis * basis.transpose();
  return left * K * left;
}

/// A stiffness-like matrix that a form can stand for.
ElementMatrix make_matrix(MatrixForm form) {
  ElementMatrix K = ElementMatrix::Random();
  K = (K * K.transpose()).eval();
  if (form == MatrixForm::kDeformations) return without(rigid_motions({0.01, 0.012, 0.007}), K);
  if (form != MatrixForm::kMirrored) return K;
  for (int axis = 0; axis < 3; ++axis) {
    ElementMatrix reflection = ElementMatrix::Zero();
    for (int n = 0; n < 8; ++n)
      for (int i = 0; i < 3; ++i) reflection(3 * (n ^ 1 << axis) + i, 3 * n + i) = i == axis ? -1.0 : 1.0;
    K = (0.5 * (K + reflection * K * reflection.transpose())).eval();
  }
  return without(rigid_motions(Vec3::Ones()).leftCols<3>(), K);
}

Mat3 half_turn(int axis) { return Eigen::AngleAxisd(M_PI, Vec3::Unit(axis)).toRotationMatrix(); }

template <typename Scalar>
struct Specimen {
  explicit Specimen(MatrixForm matrix_form) : form(matrix_form) {
    std::srand(7);
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool is_own = form == MatrixForm::kTriangles || form == MatrixForm::kDeformations;
      matrices.push_back(lane > 0 && !is_own ? matrices.front() : make_matrix(form));
      rotations.push_back(lane < 3 ? half_turn(lane) : Eigen::Quaterniond::UnitRandom().toRotationMatrix());
      for (int n = 0; n < 8; ++n) nodes[n * kLanes + lane] = (11 * n + 3 * lane) % kNodes;
      for (int i = 0; i < 3; ++i)
        rotation[i * kLanes + lane] = static_cast<Scalar>(rodrigues_parameters(rotations.back())[i]);
    }
    x.setRandom();
    x.row(3).setZero();
    pack();
  }

  /// By the product's own means, which have to find the form.
  void pack() {
    ElementSet set;
    set.node_count = 8 * kLanes;
    for (int lane = 0; lane < kLanes; ++lane) {
      set.block.push_back(Vec3i(2 * lane, 0, 0));
      set.nodes.emplace_back();
      for (int n = 0; n < 8; ++n) set.nodes.back()[n] = 8 * lane + n;
      set.stiffness.push_back(lane > 0 && matrices[lane] == matrices.front()
                                  ? set.stiffness.front()
                                  : std::make_shared<const RestMatrix>(matrices[lane]));
    }
    packed = PackedStiffness<Scalar>(TiledElements(std::move(set)));
    stiffness = packed.of_batch(0);
    ASSERT_EQ(packed.form(0), form);
  }

  Eigen::Matrix<double, 24, 1> expected(int lane) const {
    Eigen::Matrix<double, 3, 8> u;
    for (int n = 0; n < 8; ++n)
      u.col(n) = rotations[lane].transpose() *
                 x.col(nodes[n * kLanes + lane]).template head<3>().template cast<double>();
    Eigen::Matrix<double, 24, 1> f = matrices[lane] * Eigen::Map<Eigen::Matrix<double, 24, 1>>(u.data());
    for (int n = 0; n < 8; ++n) f.segment<3>(3 * n) = (rotations[lane] * f.segment<3>(3 * n)).eval();
    return f;
  }

  ElementBatch<Scalar> batch(Scalar* y) const { return {form, stiffness, rotation, nodes, x.data(), y}; }

  MatrixForm form;
  std::vector<ElementMatrix> matrices;
  std::vector<Mat3> rotations;
  PackedStiffness<Scalar> packed;
  const Scalar* stiffness = nullptr;
  Scalar rotation[3 * kLanes];
  int nodes[8 * kLanes];
  Eigen::Matrix<Scalar, 4, kNodes> x;
};

template <typename Scalar>
void expect_products(MatrixForm form, void (*multiply)(const ElementBatch<Scalar>&), double tolerance) {
  const Specimen<Scalar> specimen(form);
  alignas(64) Scalar y[32 * kLanes];
  multiply(specimen.batch(y));
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto expected = specimen.expected(lane);
    for (int n = 0; n < 8; ++n) {
      const Scalar* quad = y + 4 * (kLanes * n + place_of_lane(lane));
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(quad[i], expected[3 * n + i], tolerance * expected.norm());
      EXPECT_EQ(quad[3], Scalar{0});
    }
  }
}

TEST(Kernels, MultiplyByEveryFormOfMatrix) {
  for (const ElementKernel& kernel : element_kernels()) {
    SCOPED_TRACE(kernel.name);
    for (MatrixForm form : kForms) {
      expect_products<float>(form, kernel.single, 1e-5);
      expect_products<double>(form, kernel.precise, 1e-13);
    }
  }
}

TEST(Kernels, DiagonalBlocksTurnWithTheirElement) {
  constexpr int kEntries[2][3][2] = {{{0, 0}, {1, 1}, {2, 2}}, {{1, 2}, {0, 2}, {0, 1}}};
  for (const ElementKernel& kernel : element_kernels()) {
    SCOPED_TRACE(kernel.name);
    for (MatrixForm form : kForms) {
      const Specimen<float> specimen(form);
      for (const bool beside : {false, true}) {
        alignas(64) float y[32 * kLanes];
        kernel.diagonal(specimen.batch(y), beside);
        for (int lane = 0; lane < kLanes; ++lane) {
          for (int n = 0; n < 8; ++n) {
            const Mat3& R = specimen.rotations[lane];
            const Mat3 block = R * specimen.matrices[lane].block<3, 3>(3 * n, 3 * n) * R.transpose();
            for (int i = 0; i < 3; ++i)
              EXPECT_NEAR(y[4 * (kLanes * n + place_of_lane(lane)) + i],
                          block(kEntries[beside][i][0], kEntries[beside][i][1]), 1e-5 * block.norm());
          }
        }
      }
    }
  }
}

TEST(Kernels, AMatrixThatIsNotMirroredIsNotTakenForOne) {
  EXPECT_TRUE(mirrored(make_matrix(MatrixForm::kMirrored)).has_value());
  EXPECT_FALSE(mirrored(make_matrix(MatrixForm::kWhole)).has_value());
  const ElementMatrix on_springs = make_matrix(MatrixForm::kMirrored) + ElementMatrix::Identity();
  EXPECT_FALSE(mirrored(on_springs).has_value());  // translations have forces
}

TEST(Kernels, AMatrixWithForcesAgainstRigidMotionsIsNotTakenForOneWithout) {
  const ElementMatrix K = make_matrix(MatrixForm::kDeformations);
  EXPECT_TRUE(deformations(K).has_value());
  const Eigen::Matrix<double, 24, 6> motions = rigid_motions({0.01, 0.012, 0.007});
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix<double, 24, 1> motion = motions.col(i).normalized();
    EXPECT_FALSE(deformations(K + 1e-6 * K.norm() * motion * motion.transpose()).has_value()) << i;
  }
}

/// Answers of all instruction sets are the first one's, and energies ½ uᵀ K u by the whole matrix.
void expect_like_answers(MatrixForm form) {
  const Specimen<double> specimen(form);
  const double size[3] = {0.9, 1.0, 1.1};
  double x[3 * 8 * kLanes], gradient[24 * kLanes];
  int nodes[8 * kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int n = 0; n < 8; ++n) {
      nodes[n * kLanes + lane] = 8 * lane + n;
      Vec3 at;
      for (int i = 0; i < 3; ++i) {
        at[i] = (n >> i & 1) * size[i] + 0.1 * specimen.x(i, (n + lane) % kNodes);
        gradient[(3 * n + i) * kLanes + lane] = ((n >> i & 1) ? 0.25 : -0.25) / size[i];
      }
      Vec3::Map(x + 3 * (8 * lane + n)) = specimen.rotations[lane] * at;
    }
  }
  std::vector<Eigen::VectorXd> answers;
  for (const CorotationKernel& kernel : corotation_kernels()) {
    alignas(64) double forces[32 * kLanes] = {}, rotations[9 * kLanes], energy[kLanes];
    bool regular[kLanes];
    kernel.respond({x, nodes, gradient, size, form, specimen.stiffness, forces, rotations, energy, regular});
    Eigen::VectorXd answer(42 * kLanes);
    answer << Eigen::Map<Eigen::VectorXd>(forces, 32 * kLanes),
        Eigen::Map<Eigen::VectorXd>(rotations, 9 * kLanes), Eigen::Map<Eigen::VectorXd>(energy, kLanes);
    answers.push_back(answer);
    for (bool is_regular : regular) EXPECT_TRUE(is_regular);
    for (int lane = 0; lane < kLanes; ++lane) {
      Mat3 R;
      for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = rotations[i * kLanes + lane];
      Eigen::Matrix<double, 24, 1> u;
      for (int n = 0; n < 8; ++n)
        u.segment<3>(3 * n) =
            R.transpose() * (Vec3::Map(x + 3 * (8 * lane + n)) - Vec3::Map(x + 3 * 8 * lane)) -
            corner_bits(n).cast<double>().cwiseProduct(Vec3::Map(size));
      const double expected = 0.5 * u.dot(specimen.matrices[lane] * u);
      EXPECT_GT(expected, 0.0);
      EXPECT_NEAR(energy[lane], expected, 1e-11 * expected);
    }
    EXPECT_LT((answer - answers.front()).norm(), 1e-12 * answers.front().norm()) << kernel.name;
  }
}

TEST(Kernels, CorotationAnswersAlikeByEveryFormOfMatrix) {
  for (MatrixForm form : kForms) expect_like_answers(form);
}

}  // namespace
}  // namespace cfem_cutting
