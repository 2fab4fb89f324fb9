#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"

namespace cfem_cutting {
namespace {

constexpr std::int64_t kMaxPixels = 4'000'000'000;

/// Unpacks gzip files on the fly.
std::string read_file(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw FileError("label image '" + path + "': not found");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw FileError("label image '" + path + "': not readable");
  std::string content;
  std::vector<char> block(1 << 20);
  int read = 0;
  while ((read = gzread(file.get(), block.data(), static_cast<unsigned>(block.size()))) > 0)
    content.append(block.data(), read);
  int status = Z_OK;
  gzerror(file.get(), &status);
  if (read < 0 || status != Z_OK)
    throw FileError("label image '" + path + "': damaged or truncated gzip data");
  return content;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

template <typename Real, typename Bits>
double as_real(std::uint64_t bits) {
  const Bits low_bits = static_cast<Bits>(bits);
  Real real;
  std::memcpy(&real, &low_bits, sizeof(real));
  return real;
}

double decode_pixel(const unsigned char* bytes, const PixelFormat& format) {
  std::uint64_t value = 0;
  for (int n = 0; n < format.bytes; ++n)
    value |= std::uint64_t{bytes[format.big_endian ? format.bytes - 1 - n : n]} << (8 * n);
  if (format.is_real)
    return format.bytes == 4 ? as_real<float, std::uint32_t>(value) : as_real<double, std::uint64_t>(value);
  const std::uint64_t sign_bit = std::uint64_t{1} << (8 * format.bytes - 1);
  if (format.is_signed && (value & sign_bit)) return -static_cast<double>(2 * sign_bit - value);
  return static_cast<double>(value);
}

[[noreturn]] void refuse_label(const std::string& path, double label) {
  std::ostringstream message;
  message << "label image '" << path << "': label " << label << "; labels must be integers from 0 to 255";
  throw FileError(message.str());
}

}  // namespace

std::vector<std::uint8_t> decode_labels(const std::string& path, const std::string& data, std::size_t first,
                                        const Vec3i& size, const PixelFormat& format) {
  const std::size_t count = std::size_t(size.x()) * size.y() * size.z();
  const std::size_t available = data.size() > first ? data.size() - first : 0;
  if (available < count * format.bytes)
    throw FileError("label image '" + path + "': truncated, " + std::to_string(available) +
                    " bytes of data where " + std::to_string(count * format.bytes) + " are needed");
  std::vector<std::uint8_t> labels(count);
  const auto* pixel = reinterpret_cast<const unsigned char*>(data.data() + first);
  for (std::size_t n = 0; n < count; ++n, pixel += format.bytes) {
    const double label = decode_pixel(pixel, format);
    if (!(label >= 0.0 && label <= 255.0) || label != std::floor(label)) refuse_label(path, label);
    labels[n] = static_cast<std::uint8_t>(label);
  }
  return labels;
}

void check_image_geometry(const std::string& path, const LabelImage& image) {
  if (image.size.minCoeff() < 1 || image.size.cast<double>().prod() > double(kMaxPixels))
    throw FileError("label image '" + path + "': each size must be at least 1, and their product at most " +
                    std::to_string(kMaxPixels));
  if (!(image.spacing.minCoeff() > 0.0) || !image.spacing.allFinite())
    throw FileError("label image '" + path + "': each spacing must be greater than 0 mm");
}

std::string inflate_from(const std::string& path, const std::string& data, std::size_t first) {
  z_stream stream{};
  constexpr int kAnyHeader = 15 + 32;
  if (inflateInit2(&stream, kAnyHeader) != Z_OK) throw FileError("label image '" + path + "': zlib failed");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  std::string unpacked;
  std::vector<unsigned char> block(1 << 20);
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0 && first < data.size()) {
      stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(data.data() + first));
      stream.avail_in = static_cast<unsigned>(std::min<std::size_t>(data.size() - first, 1 << 30));
      first += stream.avail_in;
    }
    stream.next_out = block.data();
    stream.avail_out = static_cast<unsigned>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END)
      throw FileError("label image '" + path + "': damaged or truncated gzip data");
    unpacked.append(reinterpret_cast<char*>(block.data()), block.size() - stream.avail_out);
  }
  return unpacked;
}

LabelImage read_label_image(const std::string& path) {
  const std::string content = read_file(path);
  if (starts_with(content, "#INRIMAGE-4")) return read_inrimage(path, content);
  if (starts_with(content, "NRRD")) return read_nrrd(path, content);
  if (is_nifti(content)) return read_nifti(path, content);
  if (is_meta_image(content)) return read_meta_image(path, content);
  throw FileError("label image '" + path + "': not an Inrimage, NRRD, NIfTI or MetaImage file");
}

}  // namespace cfem_cutting
