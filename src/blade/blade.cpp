#include "cfem_cutting/blade/blade.h"

#include <sstream>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {
constexpr double kLeastSine = 1e-3;  // between edge and back
}

Blade make_blade(const Polyline& edge, const Vec3& back, double friction) {
  if (edge.size() < 2)
    throw ConfigError("blade.edge: " + std::to_string(edge.size()) + " point(s): an edge needs at least two");
  for (std::size_t i = 1; i < edge.size(); ++i) {
    if ((edge[i] - edge[i - 1]).norm() > 0.0) continue;
    throw ConfigError("blade.edge: points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                      " coincide: neighbours must differ");
  }
  if (!(back.norm() > 0.0)) throw ConfigError("blade.back: [0, 0, 0]: must not be zero");
  for (std::size_t i = 1; i < edge.size(); ++i)
    if ((edge[i] - edge[i - 1]).normalized().cross(back.normalized()).norm() < kLeastSine)
      throw ConfigError("blade.back: is along the edge from point " + std::to_string(i) + " to " +
                        std::to_string(i + 1) + ": must point from the edge to the spine");
  return {edge, back.normalized(), friction};
}

Front place(const Blade& blade, const Pose& X_TB, double max_segment) {
  Front front;
  front.points = refine(blade.edge, max_segment);
  for (Vec3& point : front.points) point = X_TB * point;
  front.back = X_TB.linear() * blade.back;
  return front;
}

Pose interpolate(const Pose& a, const Pose& b, double s) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(a.linear()).slerp(s, Eigen::Quaterniond(b.linear()));
  Pose between = Pose::Identity();
  between.linear() = rotation.toRotationMatrix();
  between.translation() =
      a.translation() + s * (b.translation() - a.translation());  // exact where they agree
  return between;
}

double travel(const Blade& blade, const Pose& a, const Pose& b) {
  double longest = 0.0;
  for (const Vec3& point : blade.edge) longest = std::max(longest, (b * point - a * point).norm());
  return longest;
}

}  // namespace cfem_cutting
