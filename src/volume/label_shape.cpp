#include <bitset>
#include <cmath>
#include <optional>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"
#include "label_change.h"
#include "smooth_field.h"

namespace cfem_cutting {
namespace {

using LabelSet = std::bitset<256>;

/// In image voxels: wide enough to hide the steps of the image, too narrow to move its surface.
constexpr double kSmoothing = 1.5;
constexpr double kGradientReach = 2.0;
constexpr double kLevel = 0.5;

double mean_spacing(const LabelImage& image) { return std::cbrt(image.spacing.prod()); }

Lattice lattice_of(const LabelImage& image) { return {Vec3::Zero(), image.spacing, image.size}; }

/// Bounds (inclusive) and number of the selected image voxels.
struct Selection {
  Vec3i first = Vec3i::Constant(std::numeric_limits<int>::max());
  Vec3i last = Vec3i::Constant(-1);
  std::int64_t count = 0;
};

Selection select(const LabelImage& image, const LabelSet& selected) {
  Selection selection;
  std::size_t n = 0;
  for (int k = 0; k < image.size.z(); ++k) {
    for (int j = 0; j < image.size.y(); ++j) {
      for (int i = 0; i < image.size.x(); ++i, ++n) {
        if (!selected[image.labels[n]]) continue;
        selection.first = selection.first.cwiseMin(Vec3i(i, j, k));
        selection.last = selection.last.cwiseMax(Vec3i(i, j, k));
        ++selection.count;
      }
    }
  }
  return selection;
}

class LabelShape final : public Shape {
 public:
  LabelShape(LabelImage image, const LabelSet& selected, const Selection& selection, const Pose& X_TS)
      : image_(std::move(image)),
        lattice_(lattice_of(image_)),
        selected_(selected),
        selection_(selection),
        X_TS_(X_TS),
        X_ST_(X_TS.inverse()),
        field_(lattice_, selection.first, selection.last, kSmoothing * mean_spacing(image_),
               [this](const Vec3i& v) { return selected_[image_.labels[lattice_.index(v)]]; }) {}

  Box bounds() const override {
    const Box bounds_S(lattice_.corner(selection_.first), lattice_.corner(selection_.last + Vec3i::Ones()));
    Box bounds;
    for (int corner = 0; corner < 8; ++corner)
      bounds.extend(X_TS_ * bounds_S.corner(static_cast<Box::CornerType>(corner)));
    return bounds;
  }

  std::vector<int> labels_along_z(double x, double y, const std::vector<double>& z) const override {
    const Vec3 per_voxel = image_.spacing.cwiseInverse();
    const Vec3 base = (X_ST_ * Vec3(x, y, 0.0)).cwiseProduct(per_voxel);
    const Vec3 along = X_ST_.linear().col(2).cwiseProduct(per_voxel);
    std::vector<int> labels(z.size());
    for (std::size_t n = 0; n < z.size(); ++n)
      labels[n] = label_at((base + z[n] * along).array().floor().cast<int>());
    return labels;
  }

  SurfacePoint exit(const Vec3& inside, const Vec3& outside) const override {
    const Vec3 point = exit_point(inside, outside);
    const Vec3 gradient_S = field_.gradient(X_ST_ * point, kGradientReach * mean_spacing(image_));
    if (!(gradient_S.norm() > 0.0)) return {point, (outside - inside).normalized()};
    return {point, X_TS_.linear() * -gradient_S.normalized()};
  }

  double volume() const override { return selection_.count * image_.spacing.prod(); }

 private:
  int label_at(const Vec3i& v) const {
    if (!lattice_.contains(v)) return -1;
    const int label = image_.labels[lattice_.index(v)];
    return selected_[label] ? label : -1;
  }

  bool smooth_inside(const Vec3& p) const { return field_.value(X_ST_ * p) > kLevel; }

  /// On the smooth surface; at an end that it passes closely on the wrong side; else where the labels end, as
  /// in parts too thin for the smooth field.
  Vec3 exit_point(const Vec3& inside, const Vec3& outside) const {
    if (smooth_inside(outside)) return outside;
    if (const std::optional<Vec3> smooth = smooth_exit(inside, outside)) return *smooth;
    return smooth_surface_grazes(inside) ? inside : find_label_change(*this, inside, outside);
  }

  /// Whether the field at p is that of a single, nearly flat border close by, not of a thin part.
  bool smooth_surface_grazes(const Vec3& p) const {
    constexpr double kClose = 0.15, kSingle = 0.7;
    const double spacing = mean_spacing(image_);
    const double steepness_of_plane = 1.0 / (kSmoothing * spacing * std::sqrt(2.0 * M_PI));
    return field_.value(X_ST_ * p) > kLevel - kClose &&
           field_.gradient(X_ST_ * p, spacing).norm() > kSingle * steepness_of_plane;
  }

  /// Where the smooth surface is met last, if it is.
  std::optional<Vec3> smooth_exit(const Vec3& inside, const Vec3& outside) const {
    const int steps =
        static_cast<int>(std::ceil(2.0 * (outside - inside).norm() / image_.spacing.minCoeff()));
    const auto point_at = [&](double t) { return Vec3(outside + t * (inside - outside)); };
    for (int step = 1; step <= steps; ++step)
      if (smooth_inside(point_at(static_cast<double>(step) / steps)))
        return bisect(point_at(static_cast<double>(step) / steps), point_at((step - 1.0) / steps),
                      [&](const Vec3& p) { return smooth_inside(p); });
    return std::nullopt;
  }

  LabelImage image_;
  Lattice lattice_;
  LabelSet selected_;
  Selection selection_;
  Pose X_TS_, X_ST_;
  SmoothField field_;
};

LabelSet label_set(const std::vector<int>& labels, const std::string& name) {
  LabelSet set;
  for (const int label : labels) {
    if (label < 0 || label > 255)
      throw GeometryError("label image '" + name + "': label " + std::to_string(label) +
                          "; labels are 0 to 255");
    set[label] = true;
  }
  return set;
}

std::string list_labels(const LabelImage& image) {
  LabelSet present;
  for (const std::uint8_t label : image.labels) present[label] = true;
  std::string list;
  for (int label = 0; label < 256; ++label)
    if (present[label]) list += (list.empty() ? "" : ", ") + std::to_string(label);
  return list;
}

}  // namespace

std::unique_ptr<Shape> make_label_shape(LabelImage image, const std::vector<int>& labels, const Pose& X_TS,
                                        const std::string& name) {
  const LabelSet selected = label_set(labels, name);
  const Selection selection = select(image, selected);
  if (selection.count == 0)
    throw GeometryError("label image '" + name + "': none of the selected labels occurs; it holds " +
                        list_labels(image));
  return std::make_unique<LabelShape>(std::move(image), selected, selection, X_TS);
}

}  // namespace cfem_cutting
