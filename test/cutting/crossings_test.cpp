#include "cfem_cutting/cutting/crossings.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <map>
#include <random>

#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact3 = std::array<Rational, 3>;

/// Voxels of 1/4 m, so that centres are exact and triangles can be put on them.
VoxelVolume cube(double edge = 2.0) {
  return VoxelVolume::sample(*make_box(Vec3::Constant(edge), Pose::Identity()), Vec3::Constant(0.25));
}

Exact3 exact(const Vec3& p) { return {Rational(p.x()), Rational(p.y()), Rational(p.z())}; }
Exact3 minus(const Exact3& a, const Exact3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
int sign(const Rational& r) { return r.sign(); }

/// det[b − a, c − a, d − a].
Rational determinant(const Exact3& a, const Exact3& b, const Exact3& c, const Exact3& d) {
  const Exact3 p = minus(b, a), q = minus(c, a), r = minus(d, a);
  return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
         p[2] * (q[0] * r[1] - q[1] * r[0]);
}

/// A lattice point, really shifted by (ε, ε², ε³), ε = 2⁻²⁰⁰.
Exact3 shifted(const Vec3& X) {
  const Rational epsilon(1, boost::multiprecision::cpp_int(1) << 200);
  Exact3 p = exact(X);
  p[0] += epsilon;
  p[1] += epsilon * epsilon;
  p[2] += epsilon * epsilon * epsilon;
  return p;
}

/// Segment ab against a triangle by five tetrahedron volumes.
bool meets(const Exact3& a, const Exact3& b, const SweptTriangle& t) {
  const Exact3 p = exact(t.corners[0]), q = exact(t.corners[1]), r = exact(t.corners[2]);
  const int side_a = sign(determinant(p, q, r, a)), side_b = sign(determinant(p, q, r, b));
  if (side_a == side_b) return false;
  const int pq = sign(determinant(a, b, p, q));
  return pq != 0 && pq == sign(determinant(a, b, q, r)) && pq == sign(determinant(a, b, r, p));
}

int upper(const VoxelVolume& volume, const LinkId& link) {
  return volume.voxel(link.voxel).neighbour[2 * link.axis + 1];
}

std::vector<LinkId> intact_links(const VoxelVolume& volume) {
  std::vector<LinkId> links;
  for (int v = 0; v < static_cast<int>(volume.voxels().size()); ++v)
    for (int axis = 0; volume.voxel(v).linked() && axis < 3; ++axis)
      if (volume.voxel(v).link[2 * axis + 1] == LinkState::kIntact) links.push_back({v, axis});
  return links;
}

std::vector<LinkId> brute_force(const VoxelVolume& volume, const SweptTriangle& t) {
  std::vector<LinkId> met;
  for (const LinkId& link : intact_links(volume))
    if (meets(shifted(volume.centre(link.voxel)), shifted(volume.centre(upper(volume, link))), t))
      met.push_back(link);
  return met;
}

std::vector<LinkId> links_of(const std::vector<Crossing>& crossings) {
  std::vector<LinkId> links;
  for (const Crossing& c : crossings) links.push_back(c.link);
  return links;
}

/// How often a surface's triangles, taken one by one, meet each link.
std::map<LinkId, int> meetings(const VoxelVolume& volume, const std::vector<SweptTriangle>& surface) {
  std::map<LinkId, int> count;
  for (const SweptTriangle& t : surface)
    for (const Crossing& c : find_crossings(volume, {t})) ++count[c.link];
  return count;
}

Vec3 random_point(std::mt19937& generator, double low, double high) {
  std::uniform_real_distribution<double> uniform(low, high);
  const double x = uniform(generator), y = uniform(generator);
  return {x, y, uniform(generator)};
}

/// Multiples of 1/8: corners of voxels, centres and points between them.
Vec3 random_tie(std::mt19937& generator, int eighths) {
  std::uniform_int_distribution<int> uniform(-1, eighths + 1);
  const int x = uniform(generator), y = uniform(generator);
  return Vec3(x, y, uniform(generator)) / 8.0;
}

/// A square grid over a plane z = f(x, y) that covers the cube; each quad split along a random diagonal, with
/// random turning.
std::vector<SweptTriangle> grid(const std::function<Vec3(int, int)>& at, int quads, std::mt19937& generator) {
  std::vector<SweptTriangle> surface;
  for (int i = 0; i < quads; ++i)
    for (int j = 0; j < quads; ++j) {
      const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const bool other = generator() % 2;
      surface.push_back(other ? SweptTriangle{{a, b, d}} : SweptTriangle{{a, b, c}});
      surface.push_back(other ? SweptTriangle{{b, c, d}} : SweptTriangle{{a, c, d}});
      if (generator() % 2) std::swap(surface.back().corners[0], surface.back().corners[1]);
    }
  return surface;
}

/// Expects every link along `axis` between two layers to be met once, and no other.
void expect_one_layer(const std::map<LinkId, int>& met, const VoxelVolume& volume, int axis, int layer) {
  std::size_t expected = 0;
  for (const LinkId& link : intact_links(volume))
    expected += link.axis == axis && volume.voxel(link.voxel).index[axis] == layer;
  EXPECT_EQ(met.size(), expected);
  for (const auto& [link, times] : met) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ(link.axis, axis);
    EXPECT_EQ(volume.voxel(link.voxel).index[axis], layer);
  }
}

TEST(Crossings, RandomTrianglesAgreeWithRationalBruteForce) {
  const VoxelVolume volume = cube(1.0);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 generator(seed);
    const SweptTriangle t{{random_point(generator, -0.2, 1.2), random_point(generator, -0.2, 1.2),
                           random_point(generator, -0.2, 1.2)}};
    EXPECT_EQ(links_of(find_crossings(volume, {t})), brute_force(volume, t)) << "seed " << seed;
  }
}

TEST(Crossings, TiesAgreeWithAReallyShiftedLattice) {
  const VoxelVolume volume = cube(1.0);
  std::size_t met = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    std::mt19937 generator(seed);
    const SweptTriangle t{{random_tie(generator, 8), random_tie(generator, 8), random_tie(generator, 8)}};
    const std::vector<LinkId> expected = brute_force(volume, t);
    EXPECT_EQ(links_of(find_crossings(volume, {t})), expected) << "seed " << seed;
    met += expected.size();
  }
  EXPECT_GT(met, 100u);
}

TEST(Crossings, PlaneThroughCentresIsWatertightWhateverItsTriangles) {
  const VoxelVolume volume = cube();
  for (int axis = 0; axis < 3; ++axis) {
    for (const int eighths : {7, 8}) {  // through centres, then along voxel faces
      std::mt19937 generator(10 * axis + eighths);
      const auto at = [&](int i, int j) {
        Vec3 X;
        X[axis] = eighths / 8.0;
        X[(axis + 1) % 3] = i * 0.125 - 0.5;
        X[(axis + 2) % 3] = j * 0.125 - 0.5;
        return X;
      };
      // The shift puts centres in the plane just above it, so the link below them is the one that is met.
      expect_one_layer(meetings(volume, grid(at, 24, generator)), volume, axis,
                       volume.lattice().voxel_at(Vec3::Constant(eighths / 8.0 - 0.13))[axis]);
    }
  }
}

TEST(Crossings, JitteredStripsOfManyFramesMeetEachLinkOnce) {
  const VoxelVolume volume = cube();
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 generator(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < 31 * 31; ++i) {
      const Vec3 jitter = 0.02 * random_point(generator, -1.0, 1.0);
      points.push_back(Vec3(0.1 * (i / 31) - 0.5 + jitter.x(), 0.1 * (i % 31) - 0.5 + jitter.y(), 1.0));
    }
    const auto at = [&](int i, int j) { return points[31 * i + j]; };
    const auto met = meetings(volume, grid(at, 30, generator));
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_one_layer(met, volume, 2, volume.lattice().voxel_at(Vec3::Constant(0.9))[2]);
  }
}

TEST(Crossings, WavyCutSeparatesTheVolume) {
  VoxelVolume volume = cube();
  std::mt19937 generator(7);
  const auto at = [](int i, int j) {
    const double x = 0.1 * i - 0.5, y = 0.1 * j - 0.5;
    return Vec3(x, y, 1.0 + 0.2 * std::sin(4.0 * x) * std::cos(3.0 * y));
  };
  for (const Crossing& c : find_crossings(volume, grid(at, 30, generator))) volume.sever(c.link, c.at);
  EXPECT_EQ(find_pieces(volume).count(), 2);
}

TEST(Crossings, PointLiesOnLinkAndPlaneAndNormalIsUnit) {
  const VoxelVolume volume = cube();
  std::mt19937 generator(3);
  const SweptTriangle t{{Vec3(-1.0, -1.0, 0.3), Vec3(5.0, -0.5, 0.9), Vec3(-0.4, 5.0, 1.4)}};
  const std::vector<Crossing> crossings = find_crossings(volume, {t});
  ASSERT_GT(crossings.size(), 64u);
  for (const Crossing& c : crossings) {
    const Vec3 way = c.at.point - volume.centre(c.link.voxel);
    EXPECT_NEAR(c.at.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR((c.at.point - t.corners[0]).dot(c.at.normal), 0.0, 1e-12);
    EXPECT_NEAR(way.norm(), way[c.link.axis], 1e-15);
    EXPECT_LE(way[c.link.axis], 0.25);
  }
}

TEST(Crossings, SeveredLinksAndEqualTrianglesAreNotMetAgain) {
  VoxelVolume volume = cube();
  const SweptTriangle t{{Vec3(-1.0, -1.0, 1.0), Vec3(5.0, -1.0, 1.0), Vec3(-1.0, 5.0, 1.0)}};
  const std::vector<Crossing> once = find_crossings(volume, {t, t});
  EXPECT_EQ(once.size(), 64u);
  for (const Crossing& c : once) volume.sever(c.link, c.at);
  EXPECT_TRUE(find_crossings(volume, {t}).empty());
}

TEST(Crossings, TrianglesWithoutAreaOrFarFromTissueMeetNothing) {
  const VoxelVolume volume = cube();
  const Vec3 a(0.125, 0.125, 0.125), b(1.125, 1.125, 1.125), c(1.625, 1.625, 1.625);
  EXPECT_TRUE(find_crossings(volume, {SweptTriangle{{a, b, c}}, SweptTriangle{{a, a, b}}}).empty());
  const Vec3 far(50.0, -50.0, 50.0);
  EXPECT_TRUE(find_crossings(volume, {SweptTriangle{{far, far + a, far + Vec3::UnitX()}}}).empty());
}

}  // namespace
}  // namespace cfem_cutting
