#include <algorithm>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

class BoxShape final : public Shape {
 public:
  BoxShape(const Vec3& size, const Pose& X_TS) : size_(size), X_TS_(X_TS), X_ST_(X_TS.inverse()) {}

  Box bounds() const override {
    Box bounds;
    const Box box_S(Vec3::Zero(), size_);
    for (int corner = 0; corner < 8; ++corner)
      bounds.extend(X_TS_ * box_S.corner(static_cast<Box::CornerType>(corner)));
    return bounds;
  }

  std::vector<int> labels_along_z(double x, double y, const std::vector<double>& z) const override {
    const Vec3 base_S = X_ST_ * Vec3(x, y, 0.0);
    const Vec3 along_S = X_ST_.linear().col(2);
    std::vector<int> labels(z.size());
    for (std::size_t n = 0; n < z.size(); ++n) labels[n] = contains(base_S + z[n] * along_S) ? 0 : -1;
    return labels;
  }

  SurfacePoint exit(const Vec3& inside, const Vec3& outside) const override {
    const Vec3 from_S = X_ST_ * inside;
    const Vec3 along_S = X_ST_ * outside - from_S;
    double exit_at = 1.0;
    Vec3 normal_S = along_S.normalized();
    for (int axis = 0; axis < 3; ++axis) {
      if (along_S[axis] == 0.0) continue;
      const double face = along_S[axis] > 0.0 ? size_[axis] : 0.0;
      const double at = (face - from_S[axis]) / along_S[axis];
      if (at >= exit_at) continue;
      exit_at = at;
      normal_S = Vec3::Unit(axis) * (along_S[axis] > 0.0 ? 1.0 : -1.0);
    }
    return {X_TS_ * (from_S + std::max(exit_at, 0.0) * along_S), X_TS_.linear() * normal_S};
  }

  double volume() const override { return size_.prod(); }

 private:
  bool contains(const Vec3& p_S) const {
    return (p_S.array() >= 0.0).all() && (p_S.array() < size_.array()).all();
  }

  Vec3 size_;
  Pose X_TS_, X_ST_;
};

}  // namespace

std::unique_ptr<Shape> make_box(const Vec3& size, const Pose& X_TS) {
  if (!(size.minCoeff() > 0.0)) throw GeometryError("box: every edge must be longer than 0 m");
  return std::make_unique<BoxShape>(size, X_TS);
}

}  // namespace cfem_cutting
