#include <algorithm>
#include <map>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"
#include "text_header.h"

namespace cfem_cutting {
namespace {

constexpr double kMillimetre = 1e-3;

/// Reads the fields up to the empty line before the data.
TextHeader parse_header(const std::string& path, const std::string& content, std::size_t& data) {
  TextHeader header(path, "NRRD");
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
    if (line[0] != '#' && colon != std::string::npos)
      header.set(line.substr(0, colon), line.substr(colon + 2));
  }
  throw FileError("label image '" + path + "': truncated, or an NRRD header without attached data");
}

/// Columns: the three direction vectors, given as "(x,y,z) (x,y,z) (x,y,z)".
Mat3 space_directions(const TextHeader& header) {
  std::string directions = header.text("space directions");
  std::replace_if(
      directions.begin(), directions.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream text(directions);
  Mat3 axes;
  for (int axis = 0; axis < 3; ++axis)
    if (!(text >> axes(0, axis) >> axes(1, axis) >> axes(2, axis)))
      header.refuse("space directions", "three vectors are needed");
  return axes;
}

bool left_handed_space(const TextHeader& header) {
  const std::string space = header.text("space");
  return space == "left-anterior-superior" || space == "LAS" || space == "3D-left-handed";
}

PixelFormat pixel_format(const TextHeader& header) {
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
  const auto found = formats.find(header.text("type"));
  if (found == formats.end()) header.refuse("type", "integers of 8, 16 or 32 bits are read");
  PixelFormat format = found->second;
  format.big_endian = header.text("endian") == "big";
  return format;
}

}  // namespace

LabelImage read_nrrd(const std::string& path, const std::string& content) {
  std::size_t data = 0;
  const TextHeader header = parse_header(path, content, data);
  if (header.text("dimension") != "3") header.refuse("dimension", "3 is read");
  const std::string encoding = header.text("encoding");
  const bool packed = encoding == "gzip" || encoding == "gz";
  if (!packed && encoding != "raw") header.refuse("encoding", "raw and gzip are read");
  if (header.has("data file") || header.has("datafile"))
    throw FileError("label image '" + path + "': NRRD with data in another file; attached data is read");

  const bool placed = header.has("space directions");
  const Mat3 axes = placed ? space_directions(header) : Mat3::Identity();
  LabelImage image;
  image.size = header.three_numbers("sizes").cast<int>();
  image.spacing = kMillimetre * (placed ? lengths(axes) : header.three_numbers("spacings"));
  check_image_geometry(path, image);
  const PixelFormat format = pixel_format(header);
  image.labels = packed ? decode_labels(path, inflate_from(path, content, data), 0, image.size, format)
                        : decode_labels(path, content, data, image.size, format);
  apply_axes(path, placed && left_handed_space(header) ? Mat3(-axes) : axes, image);
  return image;
}

}  // namespace cfem_cutting
