#include <map>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"

namespace cfem_cutting {
namespace {

constexpr std::size_t kHeaderBlock = 256;
constexpr double kMillimetre = 1e-3;

using Header = std::map<std::string, std::string>;

Header parse_header(const std::string& text) {
  Header header;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    std::string value = line.substr(equals + 1);
    while (!value.empty() && std::isspace(static_cast<unsigned char>(value.back()))) value.pop_back();
    header[line.substr(0, equals)] = value;
  }
  return header;
}

double number(const std::string& path, const Header& header, const std::string& key) {
  const auto entry = header.find(key);
  std::istringstream text(entry == header.end() ? "" : entry->second);
  double value = 0.0;
  if (!(text >> value))
    throw FileError("label image '" + path + "': the Inrimage header lacks a number for " + key);
  return value;
}

PixelFormat pixel_format(const std::string& path, Header header) {
  PixelFormat format;
  format.is_signed = header["TYPE"] == "signed fixed";
  format.bytes = static_cast<int>(number(path, header, "PIXSIZE")) / 8;
  format.big_endian = header["CPU"] == "sun" || header["CPU"] == "sgi";
  const bool integers = header["TYPE"] == "unsigned fixed" || format.is_signed;
  const bool scalar = header.count("VDIM") == 0 || header["VDIM"] == "1";
  if (!integers || !scalar || (format.bytes != 1 && format.bytes != 2 && format.bytes != 4))
    throw FileError("label image '" + path + "': TYPE=" + header["TYPE"] + ", PIXSIZE=" + header["PIXSIZE"] +
                    "; fixed numbers of 8, 16 or 32 bits, one a pixel, are read");
  return format;
}

}  // namespace

LabelImage read_inrimage(const std::string& path, const std::string& content) {
  const std::size_t header_end = content.find("##}");
  if (header_end == std::string::npos)
    throw FileError("label image '" + path + "': truncated, the Inrimage header has no end");
  const Header header = parse_header(content.substr(0, header_end));
  LabelImage image;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "XYZ"[axis]);
    image.size[axis] = static_cast<int>(number(path, header, name + "DIM"));
    image.spacing[axis] = kMillimetre * number(path, header, "V" + name);
  }
  check_image_geometry(path, image);
  const std::size_t data = (header_end / kHeaderBlock + 1) * kHeaderBlock;
  image.labels = decode_labels(path, content, data, image.size, pixel_format(path, header));
  return image;
}

}  // namespace cfem_cutting
