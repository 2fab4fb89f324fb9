#pragma once

#include <string>

#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {

/// Bytes of a pixel in a file.
struct PixelFormat {
  int bytes = 1;
  bool is_signed = false;
  bool big_endian = false;
};

/// @param data starts at the first pixel
/// @throw FileError fewer bytes than the image needs; a label outside 0 … 255.
std::vector<std::uint8_t> decode_labels(const std::string& path, const std::string& data, std::size_t first,
                                        const Vec3i& size, const PixelFormat& format);

/// @throw FileError a size or spacing that isn't positive, or too many pixels to hold.
void check_image_geometry(const std::string& path, const LabelImage& image);

/// Undoes gzip or zlib compression of data[first…].
std::string inflate_from(const std::string& path, const std::string& data, std::size_t first);

/// @param content the whole file
LabelImage read_inrimage(const std::string& path, const std::string& content);
LabelImage read_nrrd(const std::string& path, const std::string& content);

}  // namespace cfem_cutting
