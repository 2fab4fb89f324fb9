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

/// Reads Inrimage (.inr, .inr.gz), NRRD (.nrrd, raw or gzip, attached data), NIfTI-1 and -2 (.nii, .nii.gz)
/// or MetaImage (.mha, .mhd with .raw or .zraw), by what the file holds. Lengths are in mm unless the file
/// says otherwise, and become metres. Where the image stands in its scanner, and how it is turned there, is
/// not applied; but an image whose axes are left-handed there is reversed along x, so that its tissue is no
/// mirror image.
/// @throw FileError missing, truncated, of a type that isn't read, axes not square to each other, labels that
/// are not integers from 0 to 255
LabelImage read_label_image(const std::string& path);

/// The image voxels with one of the selected labels.
/// @throw GeometryError none of them occurs; the message lists those that do.
std::unique_ptr<Shape> make_label_shape(LabelImage image, const std::vector<int>& labels, const Pose& X_TS,
                                        const std::string& name);

}  // namespace cfem_cutting
