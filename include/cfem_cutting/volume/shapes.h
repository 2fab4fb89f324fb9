#pragma once
/// The three kinds of tissue source.

#include <memory>
#include <string>
#include <vector>

#include "cfem_cutting/geometry/triangle_mesh.h"
#include "cfem_cutting/volume/shape.h"

namespace cfem_cutting {

/// Box from the tissue frame's origin to `size` (m), placed by X_TS.
std::unique_ptr<Shape> make_box(const Vec3& size, const Pose& X_TS);

/// Inside of a closed mesh.
/// @throw GeometryError open, non-manifold, turned inside out beyond repair, or empty; the message says what
/// and where.
std::unique_ptr<Shape> make_mesh_shape(TriangleMesh mesh, double scale, const Pose& X_TS,
                                       const std::string& name);

/// 3D image of labels. Voxel (0, 0, 0) of the image has its lower corner at the shape's origin.
struct LabelImage {
  Vec3i size = Vec3i::Zero();
  Vec3 spacing = Vec3::Ones();       ///< m
  std::vector<std::uint8_t> labels;  ///< x fastest; labels above 255 are refused by the readers
};

/// Reads Inrimage (.inr, .inr.gz) or NRRD (.nrrd, raw or gzip, attached data); millimetres become metres.
/// Where the image stands in its scanner (NRRD space origin, the axes' directions) is not applied.
/// @throw FileError missing, truncated, or of a type that isn't read.
LabelImage read_label_image(const std::string& path);

/// The image voxels with one of the selected labels.
/// @throw GeometryError none of them occurs; the message lists those that do.
std::unique_ptr<Shape> make_label_shape(LabelImage image, const std::vector<int>& labels, const Pose& X_TS,
                                        const std::string& name);

}  // namespace cfem_cutting
