#include <cstdlib>

#include "cfem_cutting/geometry/polyline.h"

int main() {
  using cfem_cutting::Vec3;
  const double distance = cfem_cutting::point_triangle_distance(Vec3(0.25, 0.25, 2.0), Vec3::Zero(),
                                                                Vec3::UnitX(), Vec3::UnitY());
  return distance == 2.0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
