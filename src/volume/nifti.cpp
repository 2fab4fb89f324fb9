#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"

namespace cfem_cutting {
namespace {

/// Where the fields that matter stand in a header (nifti1.h and nifti2.h of the NIfTI working group), bytes.
struct Layout {
  std::size_t size, magic, datatype, dim, pixdim, vox_offset, scl_slope, scl_inter, units, qform, sform, srow;
};
constexpr Layout kNifti1{348, 344, 70, 40, 76, 108, 112, 116, 123, 252, 254, 280};
constexpr Layout kNifti2{540, 4, 12, 16, 104, 168, 176, 184, 500, 344, 348, 400};

struct Header {
  int version = 1;  ///< 1 or 2
  bool big_endian = false;
  int datatype = 0;
  std::array<std::int64_t, 8> dim{};  ///< number of dimensions, then their sizes
  std::array<double, 8> pixdim{};     ///< −1 for a qform that mirrors, then the spacings
  double vox_offset = 0.0;            ///< bytes before the first pixel
  double slope = 0.0, intercept = 0.0;
  int units = 0, qform = 0, sform = 0;
  Mat3 srow;  ///< the linear part of the sform
};

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw FileError("label image '" + path + "': " + what);
}

/// Numbers in the file's byte order.
class Numbers {
 public:
  Numbers(const std::string& content, bool big_endian) : content_(content), big_endian_(big_endian) {}

  template <typename T>
  T at(std::size_t offset, std::size_t index = 0) const {
    std::uint64_t bits = 0;
    for (std::size_t n = 0; n < sizeof(T); ++n) {
      const std::size_t byte = big_endian_ ? sizeof(T) - 1 - n : n;
      bits |= std::uint64_t{static_cast<unsigned char>(content_[offset + index * sizeof(T) + byte])}
              << (8 * n);
    }
    return number<T>(bits);
  }

 private:
  template <typename T>
  static T number(std::uint64_t bits) {
    if constexpr (std::is_integral_v<T>) return static_cast<T>(bits);
    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t> same_size = bits;
    T real;
    std::memcpy(&real, &same_size, sizeof(T));
    return real;
  }

  const std::string& content_;
  bool big_endian_;
};

bool starts_with_size(const std::string& content, std::size_t size, bool big_endian) {
  return content.size() >= 4 && Numbers(content, big_endian).at<std::uint32_t>(0) == size;
}

/// @tparam Integer, Real, Code the types of sizes, of spacings and of the coordinate codes
template <typename Integer, typename Real, typename Code>
void read_fields(const Numbers& numbers, const Layout& at, Header& header) {
  header.datatype = numbers.at<std::int16_t>(at.datatype);
  for (int n = 0; n < 8; ++n) {
    header.dim[n] = numbers.at<Integer>(at.dim, n);
    header.pixdim[n] = numbers.at<Real>(at.pixdim, n);
  }
  header.slope = numbers.at<Real>(at.scl_slope);
  header.intercept = numbers.at<Real>(at.scl_inter);
  header.qform = numbers.at<Code>(at.qform);
  header.sform = numbers.at<Code>(at.sform);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      header.srow(row, column) = numbers.at<Real>(at.srow, 4 * row + column);
}

void check_magic(const std::string& path, const std::string& content, const Layout& at) {
  if (content.size() < at.size) refuse(path, "truncated, the NIfTI header has no end");
  const std::string magic = content.substr(at.magic, 3);
  if (magic == "ni1" || magic == "ni2")
    refuse(path, "NIfTI with data in another file (.img); a single file (.nii) is read");
  if (magic != "n+1" && magic != "n+2")
    refuse(path, "ANALYZE, which leaves left and right open; NIfTI is read");
}

Header parse_header(const std::string& path, const std::string& content) {
  Header header;
  header.big_endian =
      starts_with_size(content, kNifti1.size, true) || starts_with_size(content, kNifti2.size, true);
  header.version = starts_with_size(content, kNifti1.size, header.big_endian) ? 1 : 2;
  const Layout& at = header.version == 1 ? kNifti1 : kNifti2;
  check_magic(path, content, at);
  const Numbers numbers(content, header.big_endian);
  if (header.version == 1) {
    read_fields<std::int16_t, float, std::int16_t>(numbers, at, header);
    header.vox_offset = numbers.at<float>(at.vox_offset);
    header.units = numbers.at<std::uint8_t>(at.units);
  } else {
    read_fields<std::int64_t, double, std::int32_t>(numbers, at, header);
    header.vox_offset = static_cast<double>(numbers.at<std::int64_t>(at.vox_offset));
    header.units = numbers.at<std::int32_t>(at.units);
  }
  return header;
}

/// Three sizes; further dimensions must have the size 1.
Vec3i image_size(const std::string& path, const Header& header) {
  const std::int64_t dimensions = header.dim[0];
  bool three = dimensions >= 3 && dimensions <= 7;
  for (int n = 4; three && n <= dimensions; ++n) three = header.dim[n] == 1;
  for (int n = 1; three && n <= 3; ++n)
    three =
        header.dim[n] >= std::numeric_limits<int>::min() && header.dim[n] <= std::numeric_limits<int>::max();
  if (!three) {
    std::ostringstream dim;
    for (const std::int64_t n : header.dim) dim << ' ' << n;
    refuse(path, "NIfTI field dim is" + dim.str() + "; one volume of three dimensions is read");
  }
  return {static_cast<int>(header.dim[1]), static_cast<int>(header.dim[2]), static_cast<int>(header.dim[3])};
}

/// m per unit of the spacings; mm where nothing is said.
double unit_of_length(const std::string& path, const Header& header) {
  static const std::map<int, double> units{{0, 1e-3}, {1, 1.0}, {2, 1e-3}, {3, 1e-6}};
  const int code = header.units & 7;
  const auto unit = units.find(code);
  if (unit == units.end())
    refuse(path, "NIfTI field xyzt_units is " + std::to_string(code) + "; m (1), mm (2) and µm (3) are read");
  return unit->second;
}

/// The image's axes as the header places them. The qform is the scanner's; the sform may be that of a
/// template, and counts if there is no other.
bool placed_by_sform(const Header& header) { return header.qform <= 0 && header.sform > 0; }

Mat3 axes_of(const Header& header) {
  if (placed_by_sform(header)) return header.srow;
  Mat3 axes = Mat3::Identity();  // but for a rotation
  if (header.qform > 0 && header.pixdim[0] < 0.0) axes(2, 2) = -1.0;
  return axes;
}

Vec3 spacing_of(const Header& header) {
  if (placed_by_sform(header)) return lengths(header.srow);
  return {header.pixdim[1], header.pixdim[2], header.pixdim[3]};
}

PixelFormat pixel_format(const std::string& path, const Header& header) {
  static const std::map<int, PixelFormat> formats{
      {2, {1, false, false, false}},   {256, {1, true, false, false}},   {4, {2, true, false, false}},
      {512, {2, false, false, false}}, {8, {4, true, false, false}},     {768, {4, false, false, false}},
      {1024, {8, true, false, false}}, {1280, {8, false, false, false}}, {16, {4, true, false, true}},
      {64, {8, true, false, true}}};
  const auto found = formats.find(header.datatype);
  if (found == formats.end())
    refuse(path, "NIfTI field datatype is " + std::to_string(header.datatype) +
                     "; integers and reals of up to 64 bits, one a pixel, are read");
  PixelFormat format = found->second;
  format.big_endian = header.big_endian;
  return format;
}

void check_unscaled(const std::string& path, const Header& header) {
  if (header.slope == 0.0 || !std::isfinite(header.slope)) return;  // stands for no scaling
  if (header.slope == 1.0 && header.intercept == 0.0) return;
  std::ostringstream what;
  what << "NIfTI fields scl_slope and scl_inter are " << header.slope << " and " << header.intercept
       << "; labels must not be scaled (1 and 0)";
  refuse(path, what.str());
}

std::size_t data_offset(const std::string& path, const std::string& content, const Header& header) {
  const std::size_t header_end = (header.version == 1 ? kNifti1.size : kNifti2.size) + 4;
  if (header.vox_offset <= 0.0) return header_end;
  if (!(header.vox_offset <= static_cast<double>(content.size())))
    refuse(path, "truncated, the data begins after the file's end");
  return std::max(header_end, static_cast<std::size_t>(header.vox_offset));
}

}  // namespace

bool is_nifti(const std::string& content) {
  for (const bool big_endian : {false, true})
    for (const Layout& at : {kNifti1, kNifti2})
      if (starts_with_size(content, at.size, big_endian)) return true;
  return false;
}

LabelImage read_nifti(const std::string& path, const std::string& content) {
  const Header header = parse_header(path, content);
  check_unscaled(path, header);
  LabelImage image;
  image.size = image_size(path, header);
  image.spacing = unit_of_length(path, header) * spacing_of(header);
  check_image_geometry(path, image);
  image.labels = decode_labels(path, content, data_offset(path, content, header), image.size,
                               pixel_format(path, header));
  apply_axes(path, axes_of(header), image);
  return image;
}

}  // namespace cfem_cutting
