#include "secant_pairs.h"

#include <gtest/gtest.h>

namespace cfem_cutting {
namespace {

/// A linear tangent that only some directions differ from the one that is solved with.
struct Springs {
  Eigen::Matrix<double, 6, 6> stiffness;
  NodeField forces(const NodeField& x) const {
    NodeField f(3, 2);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(f.data()) =
        -stiffness * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(x.data());
    return f;
  }
};

Springs two_stiff_directions() {
  std::srand(5);
  const Eigen::Matrix<double, 6, 2> stiff = Eigen::Matrix<double, 6, 2>::Random();
  return {Eigen::Matrix<double, 6, 6>::Identity() + 9.0 * stiff * stiff.transpose()};
}

TEST(SecantPairs, TakeWhatTheyKnowToTheEquilibrium) {
  const Springs springs = two_stiff_directions();
  const auto as_if_soft = [](const NodeField& load) { return load; };
  SecantPairs secants;
  NodeField last;
  for (int i = 0; i < 2; ++i) {
    last = NodeField::Random(3, 2);
    secants.add(last, -springs.forces(last));
  }
  // What the last step brought about is taken back by going back.
  EXPECT_LT((secants.direction(springs.forces(last), as_if_soft) + last).norm(), 1e-12);
}

TEST(SecantPairs, ReachALinearEquilibriumInAFewSteps) {
  const Springs springs = two_stiff_directions();
  const auto as_if_stiff = [](const NodeField& load) { return NodeField(0.05 * load); };
  SecantPairs secants;
  NodeField x = NodeField::Ones(3, 2);
  const double before = x.norm();
  for (int i = 0; i < 12; ++i) {
    const NodeField f = springs.forces(x);
    const NodeField step = secants.direction(f, as_if_stiff);
    EXPECT_GT(f.cwiseProduct(step).sum(), 0.0);
    x += step;
    secants.add(step, f - springs.forces(x));
  }
  EXPECT_LT(x.norm(), 1e-6 * before);  // without: 0.95^12 of it
}

TEST(SecantPairs, LeaveOutStepsAgainstTheForces) {
  SecantPairs secants;
  secants.add(NodeField::Ones(3, 2), -NodeField::Ones(3, 2));
  EXPECT_TRUE(secants.empty());
  secants.add(NodeField::Ones(3, 2), NodeField::Ones(3, 2));
  EXPECT_FALSE(secants.empty());
  secants.clear();
  EXPECT_TRUE(secants.empty());
}

}  // namespace
}  // namespace cfem_cutting
