#pragma once

#include <cmath>
#include <random>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting::random_cuts {

/// Random choices, the same for the same seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}

  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1.0p-53;
  }
  /// low … high, both included.
  int integer(int low, int high) { return low + static_cast<int>(generator_() % (high - low + 1)); }
  /// All orders of magnitude alike.
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Vec3 vector(double largest) {
    const double x = uniform(-largest, largest), y = uniform(-largest, largest);
    return {x, y, uniform(-largest, largest)};
  }
  /// Each component −1, 0 or 1, not all 0.
  Vec3 step() {
    Vec3 way = Vec3::Zero();
    while (way.isZero())
      for (double& component : way) component = integer(-1, 1);
    return way;
  }
  Mat3 rotation() {
    Eigen::Vector4d q = Eigen::Vector4d::Zero();
    while (!(q.norm() > 0.1 && q.norm() < 1.0)) {
      const Vec3 v = vector(1.0);
      q << v, uniform(-1.0, 1.0);
    }
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace cfem_cutting::random_cuts
