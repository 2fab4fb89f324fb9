#include <algorithm>
#include <map>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"

namespace cfem_cutting {
namespace {

constexpr double kMillimetre = 1e-3;

using Header = std::map<std::string, std::string>;

/// Reads the fields up to the empty line before the data.
Header parse_header(const std::string& path, const std::string& content, std::size_t& data) {
  Header header;
  std::size_t begin = content.find('\n');
  while (begin != std::string::npos) {
    const std::size_t end = content.find('\n', ++begin);
    if (end == std::string::npos) break;
    std::string line = content.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    begin = end;
    if (line.empty()) {
      data = end + 1;
      return header;
    }
    const std::size_t colon = line.find(": ");
    if (line[0] != '#' && colon != std::string::npos) header[line.substr(0, colon)] = line.substr(colon + 2);
  }
  throw FileError("label image '" + path + "': truncated, or an NRRD header without attached data");
}

[[noreturn]] void refuse(const std::string& path, const std::string& key, const std::string& value,
                         const std::string& rule) {
  throw FileError("label image '" + path + "': NRRD field " + key + " is '" + value + "'; " + rule);
}

Vec3 three_numbers(const std::string& path, Header header, const std::string& key) {
  std::istringstream text(header[key]);
  Vec3 numbers;
  if (!(text >> numbers.x() >> numbers.y() >> numbers.z()))
    refuse(path, key, header[key], "three numbers are needed");
  return numbers;
}

/// Lengths of the three direction vectors, as "(x,y,z) (x,y,z) (x,y,z)".
Vec3 direction_lengths(const std::string& path, std::string directions) {
  const std::string given = directions;
  std::replace_if(
      directions.begin(), directions.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream text(directions);
  Vec3 lengths;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction;
    if (!(text >> direction.x() >> direction.y() >> direction.z()))
      refuse(path, "space directions", given, "three vectors are needed");
    lengths[axis] = direction.norm();
  }
  return lengths;
}

PixelFormat pixel_format(const std::string& path, Header header) {
  static const std::map<std::string, PixelFormat> formats{
      {"uchar", {1, false, false}},          {"unsigned char", {1, false, false}},
      {"uint8", {1, false, false}},          {"uint8_t", {1, false, false}},
      {"signed char", {1, true, false}},     {"int8", {1, true, false}},
      {"int8_t", {1, true, false}},          {"short", {2, true, false}},
      {"signed short", {2, true, false}},    {"int16", {2, true, false}},
      {"int16_t", {2, true, false}},         {"ushort", {2, false, false}},
      {"unsigned short", {2, false, false}}, {"uint16", {2, false, false}},
      {"uint16_t", {2, false, false}},       {"int", {4, true, false}},
      {"int32", {4, true, false}},           {"int32_t", {4, true, false}},
      {"uint", {4, false, false}},           {"unsigned int", {4, false, false}},
      {"uint32", {4, false, false}},         {"uint32_t", {4, false, false}}};
  const auto found = formats.find(header["type"]);
  if (found == formats.end()) refuse(path, "type", header["type"], "integers of 8, 16 or 32 bits are read");
  PixelFormat format = found->second;
  format.big_endian = header["endian"] == "big";
  return format;
}

Vec3 spacing(const std::string& path, const Header& header) {
  const auto directions = header.find("space directions");
  if (directions != header.end()) return direction_lengths(path, directions->second);
  return three_numbers(path, header, "spacings");
}

}  // namespace

LabelImage read_nrrd(const std::string& path, const std::string& content) {
  std::size_t data = 0;
  Header header = parse_header(path, content, data);
  if (header["dimension"] != "3") refuse(path, "dimension", header["dimension"], "3 is read");
  const std::string encoding = header["encoding"];
  const bool packed = encoding == "gzip" || encoding == "gz";
  if (!packed && encoding != "raw") refuse(path, "encoding", encoding, "raw and gzip are read");
  if (header.count("data file") + header.count("datafile") > 0)
    throw FileError("label image '" + path + "': NRRD with data in another file; attached data is read");

  LabelImage image;
  image.size = three_numbers(path, header, "sizes").cast<int>();
  image.spacing = kMillimetre * spacing(path, header);
  check_image_geometry(path, image);
  const PixelFormat format = pixel_format(path, header);
  image.labels = packed ? decode_labels(path, inflate_from(path, content, data), 0, image.size, format)
                        : decode_labels(path, content, data, image.size, format);
  return image;
}

}  // namespace cfem_cutting
