#pragma once

#include <string>

#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {

/// Bytes of a pixel in a file.
struct PixelFormat {
  int bytes = 1;  ///< 1, 2, 4 or 8; real: 4 or 8
  bool is_signed = false;
  bool big_endian = false;
  bool is_real = false;  ///< IEEE 754
};

/// @param data starts at the first pixel
/// @throw FileError fewer bytes than the image needs; a label that is not an integer from 0 to 255.
std::vector<std::uint8_t> decode_labels(const std::string& path, const std::string& data, std::size_t first,
                                        const Vec3i& size, const PixelFormat& format);

/// @throw FileError a size or spacing that isn't positive, or too many pixels to hold.
void check_image_geometry(const std::string& path, const LabelImage& image);

/// Reverses the image's x axis if its axes are left-handed, so that no tissue is a mirror image.
/// @param axes columns: the image's axes in a right-handed frame, of any lengths
/// @throw FileError axes that aren't square to each other (0.6°)
void apply_axes(const std::string& path, const Mat3& axes, LabelImage& image);

/// The axes' lengths.
inline Vec3 lengths(const Mat3& axes) { return axes.colwise().norm().transpose(); }

/// Undoes gzip or zlib compression of data[first…].
std::string inflate_from(const std::string& path, const std::string& data, std::size_t first);

/// @param content the whole file
LabelImage read_inrimage(const std::string& path, const std::string& content);
LabelImage read_nrrd(const std::string& path, const std::string& content);
LabelImage read_nifti(const std::string& path, const std::string& content);
LabelImage read_meta_image(const std::string& path, const std::string& content);

/// By how the file starts: a NIfTI or ANALYZE header's size; a MetaImage's first field.
bool is_nifti(const std::string& content);
bool is_meta_image(const std::string& content);

}  // namespace cfem_cutting
