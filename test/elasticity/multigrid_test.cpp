// The multigrid cycle as a preconditioner, from inside.

#include <gtest/gtest.h>

#include "cfem_cutting/volume/voxel_volume.h"
#include "conjugate_gradients.h"
#include "specimens.h"

namespace cfem_cutting {
namespace {

const Material kTissue{-1, 1e4, 0.45, 1060.0};

ElasticModel model_of(const VoxelVolume& volume) {
  return {volume, 0, {kTissue}, ElementKind::kIncompatibleModes, Kinematics::kCorotational};
}

/// A tilted block, cut halfway through.
VoxelVolume cut_block() {
  VoxelVolume volume = tilted_volume({0.12, 0.1, 0.09}, 0.01);
  const Vec3 centre = volume.lattice().centre(volume.lattice().size / 2);
  for (std::size_t v = 0; v < volume.voxels().size(); ++v) {
    const Voxel& voxel = volume.voxels()[v];
    const Vec3 X = volume.centre(static_cast<int>(v));
    const bool crosses = X.x() < centre.x() && X.x() + 0.01 >= centre.x() && X.z() > centre.z();
    if (crosses && voxel.linked() && voxel.neighbour[1] >= 0 && voxel.link[1] == LinkState::kIntact)
      volume.sever({static_cast<int>(v), 0}, {Vec3(centre.x(), X.y(), X.z()), Vec3::UnitX()});
  }
  return volume;
}

struct Cycle : testing::Test {
  VoxelVolume volume = cut_block();
  ElasticModel model = model_of(volume);
  int count = model.mesh().node_count();
  NodeField x = model.mesh().rest();
  std::vector<int> held{0, 1, 2, 3, 10};
  std::vector<PointConstraint> constraints;
  ThreadPool pool{1};
  Multigrid multigrid{pool};

  void SetUp() override {
    for (Eigen::Index n = 0; n < x.cols(); ++n)  // bent
      x.col(n) = Eigen::AngleAxisd(8.0 * x(0, n), Vec3(0.3, 1.0, 0.2).normalized()) * Vec3(x.col(n));
    for (const int voxel : {3, 40}) {
      PointConstraint c;
      c.at = model.mesh().embed(voxel, volume.centre(voxel));
      c.direction = Vec3(1.0, 2.0, -1.0).normalized();
      c.stiffness = 2e3;
      constraints.push_back(c);
    }
    multigrid.arrange(model, held);
    multigrid.set(model.rotations(x), {Eigen::VectorXd::Constant(count, 0.5), 2.0, &constraints});
  }

  SingleField random(unsigned seed) const {
    std::srand(seed);
    SingleField field = to_quads(NodeField::Random(3, count));
    for (int node : held) field.col(node).setZero();
    return field;
  }

  static double dot(const SingleField& a, const SingleField& b) {
    return a.cast<double>().cwiseProduct(b.cast<double>()).sum();
  }
};

TEST_F(Cycle, IsSymmetricAndPositive) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const SingleField a = random(2 * seed), b = random(2 * seed + 1);
    SingleField Ba, Bb;
    multigrid.precondition(a, Ba);
    multigrid.precondition(b, Bb);
    EXPECT_NEAR(dot(a, Bb), dot(Ba, b), 1e-5 * std::sqrt(dot(a, Ba) * dot(b, Bb)));
    EXPECT_GT(dot(a, Ba), 0.0);
    for (int node : held) EXPECT_EQ(Ba.col(node).norm(), 0.0f);
  }
}

TEST_F(Cycle, TakesMostOfAnyErrorAway) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SingleField error = random(seed), r, z;
    multigrid.finest().apply(error, r);
    for (int node : held) r.col(node).setZero();
    const double before = dot(error, r);
    multigrid.precondition(r, z);
    error -= z;
    multigrid.finest().apply(error, r);
    for (int node : held) r.col(node).setZero();
    EXPECT_LT(dot(error, r), 0.3 * before);
  }
}

TEST_F(Cycle, InterpolationKeepsRigidTranslations) {
  const Coarsening coarsening(*model.elements());
  EXPECT_LT(coarsening.coarse.size(), model.elements()->set.size() / 3);
  const SingleField ones = SingleField::Ones(4, coarsening.coarse.node_count);
  SingleField fine;
  coarsening.interpolation.apply(pool, ones, fine);
  EXPECT_LT((fine.array() - 1.0f).abs().maxCoeff(), 1e-6f);
}

TEST_F(Cycle, ProlongationAddsWhatInterpolationMakes) {
  const Coarsening coarsening(*model.elements());
  const SingleField coarse = SingleField::Random(4, coarsening.coarse.node_count);
  SingleField fine;
  coarsening.interpolation.apply(pool, coarse, fine);
  SingleField sum = SingleField::Ones(4, count);
  Prolongation(coarsening.interpolation).add(pool, coarse, sum);
  EXPECT_LT((sum - fine - SingleField::Ones(4, count)).array().abs().maxCoeff(), 1e-5f);
}

/// The largest change of the nodes' blocks, over their largest entry, when all elements turn.
float change_of_diagonal(const ElasticModel& model, ThreadPool& pool, const Vec3& axis, double angle) {
  ElementProduct product(pool);
  product.arrange(model.elements());
  product.update_diagonal();
  const std::vector<NodeBlock> before = product.diagonal();
  const Mat3 R = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  product.rotate(std::vector<Mat3>(model.elements()->set.size(), R));
  product.update_diagonal();
  const std::vector<NodeBlock>& after = product.diagonal();
  float largest = 0.0f, change = 0.0f;
  for (std::size_t n = 0; n < before.size(); ++n) {
    for (int i = 0; i < 6; ++i) {
      largest = std::max(largest, std::abs(before[n].entries[i]));
      change = std::max(change, std::abs(after[n].entries[i] - before[n].entries[i]));
    }
  }
  return change / largest;
}

TEST_F(Cycle, NodeBlocksStayUntilElementsHaveTurned) {
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    EXPECT_EQ(change_of_diagonal(model, pool, axis, 0.9 * ElementProduct::kDiagonalTurn), 0.0f);
    EXPECT_GT(change_of_diagonal(model, pool, axis, 1.1 * ElementProduct::kDiagonalTurn), 1e-3f);
  }
}

/// What a hierarchy keeps from the values before does not show.
TEST_F(Cycle, FollowsTheValues) {
  const SingleField r = random(1);
  const std::vector<std::pair<double, double>> values{{0.5, 1.0}, {80.0, 1.0}, {80.0, 2.0}, {0.0, 2.0}};
  for (const auto& [diagonal, factor] : values) {
    const SystemValues now{Eigen::VectorXd::Constant(count, diagonal), factor, &constraints};
    Multigrid fresh(pool);
    fresh.arrange(model, held);
    fresh.set(model.rotations(x), now);
    multigrid.set(model.rotations(x), now);
    SingleField expected, z;
    fresh.precondition(r, expected);
    multigrid.precondition(r, z);
    EXPECT_EQ(z, expected) << diagonal << ", " << factor;
  }
}

TEST_F(Cycle, FollowsTheModel) {
  SingleField before, after;
  const SingleField r = random(1);
  multigrid.precondition(r, before);
  model.update(volume);  // nothing was severed
  multigrid.arrange(model, held);
  multigrid.set(model.rotations(x), {Eigen::VectorXd::Constant(count, 0.5), 2.0, &constraints});
  multigrid.precondition(r, after);
  EXPECT_EQ(before, after);
}

/// Rotations without any order, as in crushed tissue.
struct CrumpledCycle : Cycle, testing::WithParamInterface<double> {
  SystemValues values{Eigen::VectorXd::Constant(count, GetParam()), 2.0, &constraints};
  std::vector<Mat3> rotations() const {
    std::srand(3);
    std::vector<Mat3> rotations(model.elements()->set.size());
    for (Mat3& R : rotations) R = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    return rotations;
  }
};
INSTANTIATE_TEST_SUITE_P(Inertia, CrumpledCycle, testing::Values(0.0, 0.5, 50.0));

TEST_P(CrumpledCycle, IsPositive) {
  multigrid.set(rotations(), values);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SingleField a = random(seed);
    SingleField Ba;
    multigrid.precondition(a, Ba);
    EXPECT_GT(dot(a, Ba), 0.0);
  }
}

TEST_P(CrumpledCycle, TissueIsSolved) {
  const LinearSystem system(multigrid, model, rotations(), values, held, Precision::kSingle);
  NodeField b = NodeField::Random(3, count), dx = NodeField::Zero(3, count);
  const SolveReport report = ConjugateGradients().solve(system, b, dx, {1e-4, 2000, 0.01});
  EXPECT_TRUE(report.converged) << report.residual << " after " << report.iterations;
  if (GetParam() > 0.0) {  // otherwise the W-cycle breaks down, and the nodes' blocks alone precondition
    EXPECT_LE(report.iterations, 40);
  }
}

/// The system of `Cycle` and its energy, ½ x·A x − b·x.
struct FirstGuess : Cycle {
  const SystemValues values{Eigen::VectorXd::Constant(count, 0.5), 2.0, &constraints};
  const LinearSystem system{multigrid, model, model.rotations(x), values, held, Precision::kSingle};

  /// A state whose velocities changed by `last` in the last step and by `earlier` before it
  static ElasticState after_changes(const NodeField& last, const NodeField& earlier) {
    const NodeField v = NodeField::Zero(3, last.cols());
    return {v, v + earlier + last, {v + earlier, v}};
  }
  NodeField free_random(unsigned seed) const { return from_quads(random(seed)); }
};

TEST_F(FirstGuess, LeavesNothingAlongTheChanges) {
  const NodeField last = free_random(1), earlier = free_random(2);
  RecentChanges changes;
  changes.take(after_changes(last, earlier), pool);
  SingleField r = random(7), guess = SingleField::Zero(4, count), Ax;
  const SingleField b = r;
  changes.minimise(system, r, guess);
  EXPECT_LT(std::abs(dot(r, to_quads(last))), 1e-4 * r.norm() * last.norm());
  EXPECT_LT(std::abs(dot(r, to_quads(earlier))), 1e-4 * r.norm() * earlier.norm());
  multigrid.finest().apply(guess, Ax);
  system.clear_held(Ax);
  EXPECT_LT((r - (b - Ax)).norm(), 1e-4 * b.norm());
}

TEST_F(FirstGuess, BearsWithChangesThatAreParallelOrZero) {
  const NodeField change = free_random(1), none = NodeField::Zero(3, count);
  for (const auto& [last, earlier] : {std::pair(change, change), {none, none}, {none, change}}) {
    RecentChanges changes;
    changes.take(after_changes(last, earlier), pool);
    SingleField r = random(7), guess = SingleField::Zero(4, count);
    const SingleField b = r;
    changes.minimise(system, r, guess);
    if (last.isZero(0.0) && earlier.isZero(0.0)) {
      EXPECT_EQ(r, b);
      EXPECT_TRUE(guess.isZero(0.0f));
    } else {
      EXPECT_LT(std::abs(dot(r, to_quads(change))), 1e-4 * r.norm() * change.norm());
    }
  }
}

TEST_F(FirstGuess, SavesIterations) {
  Integrator integrator({});
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, count)};
  HeldNodes bottom;
  for (int node : held) bottom.nodes.push_back(node), bottom.positions.push_back(state.x.col(node));
  const auto step = [&](ElasticState& s) {
    return integrator.step(model, s, 0.01, {0, 0, -9.81}, bottom, {}).iterations;
  };
  int with = 0, without = 0;
  for (int i = 0; i < 10; ++i) {
    ElasticState forgetful{state.x, state.v};
    without += step(forgetful);
    with += step(state);
    EXPECT_LT((state.x - forgetful.x).norm(), 1e-3 * state.v.norm() * 0.01);
  }
  EXPECT_LE(with, 0.9 * without);
}

TEST(Multigrid, TissueInManyPiecesIsSolved) {
  VoxelVolume volume = box_volume({0.18, 0.18, 0.06}, 0.01);
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v)
    for (int axis = 0; axis < 3; ++axis)
      if (volume.voxel(v).index[axis] % 2 == 1 && volume.voxel(v).neighbour[2 * axis + 1] >= 0)
        volume.sever({v, axis}, {volume.centre(v) + 0.005 * Vec3::Unit(axis), Vec3::Unit(axis)});
  const ElasticModel model = model_of(volume);
  EXPECT_GE(find_pieces(volume).count(), 243);  // cubes of two voxels an edge
  SolverOptions options;
  options.threads = 1;
  Integrator integrator(options);
  ElasticState state{model.mesh().rest(), NodeField::Zero(3, model.mesh().node_count())};
  state.v.row(0).setRandom();
  for (int step = 0; step < 3; ++step) {
    const SolveReport report = integrator.step(model, state, 0.01, {0, 0, -9.81}, {}, {});
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 12);
  }
}

}  // namespace
}  // namespace cfem_cutting
