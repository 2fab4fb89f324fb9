// The vertex of a cell with skin and cut.

#include "error_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cfem_cutting {
namespace {

struct Planes {
  std::vector<SurfacePoint> skin;
  SurfacePoint cut;
};

class Cells {
 public:
  Planes next() {
    Planes planes;
    planes.cut = {on_edge(), normal()};
    const int count = 1 + static_cast<int>(random_() % 3);
    for (int i = 0; i < count; ++i) planes.skin.push_back({on_edge(), normal()});
    return planes;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vec3 normal() { return Vec3(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5).normalized(); }
  /// Of the unit cell.
  Vec3 on_edge() {
    Vec3 X(random_() % 2, random_() % 2, random_() % 2);
    X[static_cast<int>(random_() % 3)] = 0.1 + 0.8 * uniform();
    return X;
  }
  std::mt19937 random_{7};
};

/// How near to the skin a point of the cut in a room can be, by trying many.
double least_misfit(const ErrorFunction& skin, const SurfacePoint& cut, const Box& room) {
  const Vec3 u = cut.normal.unitOrthogonal(), v = cut.normal.cross(u);
  double least = 1e9;
  for (double s = -1.8; s < 1.8; s += 0.03)
    for (double t = -1.8; t < 1.8; t += 0.03) {
      const Vec3 X = cut.point + s * u + t * v;
      if (room.contains(X)) least = std::min(least, skin.misfit(X));
    }
  return least;
}

TEST(Minimum, IsOnTheCutWhereTheSkinCanBeNearIt) {
  const Box room(Vec3::Constant(-0.01), Vec3::Constant(1.01));
  Cells cells;
  int near = 0, far = 0;
  for (int n = 0; n < 400; ++n) {
    const Planes planes = cells.next();
    ErrorFunction skin, cut;
    cut.add(planes.cut);
    for (const SurfacePoint& plane : planes.skin) skin.add(plane);
    const Vec3 X = minimum(skin, cut, room);
    EXPECT_LE(room.exteriorDistance(X), 1e-12) << "cell " << n;
    const double possible = least_misfit(skin, planes.cut, room);
    if (possible < 0.1) {
      ++near;
      EXPECT_LT(std::abs(planes.cut.normal.dot(X - planes.cut.point)), 1e-9)
          << "cell " << n << ", the skin's misfit could be " << possible;
      EXPECT_LT(skin.misfit(X), 0.35) << "cell " << n;
    } else if (possible > 0.25) {
      ++far;
      EXPECT_LT(skin.misfit(X), skin.misfit(planes.cut.point) + 0.5) << "cell " << n;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(far, 10);
}

TEST(ErrorFunction, OfBothHasTheMisfitOfAllPlanes) {
  Cells cells;
  for (int n = 0; n < 50; ++n) {
    const Planes a = cells.next(), b = cells.next();
    ErrorFunction first, second, all;
    for (const SurfacePoint& plane : a.skin) first.add(plane), all.add(plane);
    for (const SurfacePoint& plane : b.skin) second.add(plane), all.add(plane);
    const Vec3 X(0.3, 0.9, -0.4);
    double squares = 0.0;
    for (const auto* planes : {&a.skin, &b.skin})
      for (const SurfacePoint& plane : *planes) squares += std::pow(plane.normal.dot(X - plane.point), 2);
    EXPECT_NEAR((first + second).misfit(X), std::sqrt(squares / all.count()), 1e-12);
    EXPECT_NEAR(all.misfit(X), std::sqrt(squares / all.count()), 1e-12);
  }
}

}  // namespace
}  // namespace cfem_cutting
