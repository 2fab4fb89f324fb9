#include <algorithm>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"

namespace cfem_cutting {
namespace {

constexpr double kMaxCosine = 0.01;  // between two axes

bool square(const Mat3& axes) {
  const Mat3 unit = axes.colwise().normalized();
  const Mat3 cosines = unit.transpose() * unit - Mat3::Identity();
  return cosines.allFinite() && cosines.cwiseAbs().maxCoeff() < kMaxCosine;
}

}  // namespace

void apply_axes(const std::string& path, const Mat3& axes, LabelImage& image) {
  if (!square(axes))
    throw FileError("label image '" + path +
                    "': its axes are sheared; they must be square to each other (resample the image)");
  if (axes.determinant() > 0.0) return;
  for (auto row = image.labels.begin(); row != image.labels.end(); row += image.size.x())
    std::reverse(row, row + image.size.x());
}

}  // namespace cfem_cutting
