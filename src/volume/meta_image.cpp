#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "label_image_files.h"
#include "text_header.h"

namespace cfem_cutting {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

/// Reads the fields up to ElementDataFile, which is the last.
/// @param data where the line after it begins
TextHeader parse_header(const std::string& path, const std::string& content, std::size_t& data) {
  TextHeader header(path, "MetaImage");
  for (std::size_t begin = 0, end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = content.substr(begin, end - begin);
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, equals));
    header.set(key, trimmed(line.substr(equals + 1)));
    data = end + 1;
    if (key == "ElementDataFile") return header;
  }
  throw FileError("label image '" + path + "': truncated, the MetaImage header does not end with a line " +
                  "ElementDataFile");
}

bool is_true(const TextHeader& header, const std::string& key) {
  const std::string word = header.text(key);
  return !word.empty() && (word[0] == 'T' || word[0] == 't' || word[0] == '1');
}

/// Of several names the one that is used, else the first.
std::string used_name(const TextHeader& header, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (header.has(name)) return name;
  return names.front();
}

/// m per unit of the spacings; mm where nothing is said.
double unit_of_length(const TextHeader& header) {
  const std::string unit = header.text("DistanceUnits");
  if (unit.empty() || unit == "?" || unit == "mm") return 1e-3;
  if (unit == "um") return 1e-6;
  if (unit == "cm") return 1e-2;
  header.refuse("DistanceUnits", "um, mm and cm are read");
}

Mat3 axes_of(const TextHeader& header) {
  const std::string key = used_name(header, {"TransformMatrix", "Rotation", "Orientation"});
  if (!header.has(key)) return Mat3::Identity();
  std::istringstream numbers(header.text(key));
  Mat3 axes;
  for (double& number : axes.reshaped())
    if (!(numbers >> number)) header.refuse(key, "nine numbers are needed");
  return axes;
}

PixelFormat pixel_format(const TextHeader& header) {
  static const std::map<std::string, PixelFormat> formats{
      {"MET_UCHAR", {1, false, false, false}},      {"MET_CHAR", {1, true, false, false}},
      {"MET_USHORT", {2, false, false, false}},     {"MET_SHORT", {2, true, false, false}},
      {"MET_UINT", {4, false, false, false}},       {"MET_INT", {4, true, false, false}},
      {"MET_ULONG_LONG", {8, false, false, false}}, {"MET_LONG_LONG", {8, true, false, false}},
      {"MET_FLOAT", {4, true, false, true}},        {"MET_DOUBLE", {8, true, false, true}}};
  const auto found = formats.find(header.text("ElementType"));
  if (found == formats.end())
    header.refuse("ElementType",
                  "MET_UCHAR, MET_CHAR, MET_USHORT, MET_SHORT, MET_UINT, MET_INT, MET_ULONG_LONG, "
                  "MET_LONG_LONG, MET_FLOAT and MET_DOUBLE are read");
  PixelFormat format = found->second;
  format.big_endian = is_true(header, used_name(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}));
  return format;
}

void check_kind(const TextHeader& header) {
  if (header.has("ObjectType") && header.text("ObjectType") != "Image")
    header.refuse("ObjectType", "Image is read");
  if (header.text("NDims") != "3") header.refuse("NDims", "3 is read");
  if (header.has("BinaryData") && !is_true(header, "BinaryData")) header.refuse("BinaryData", "True is read");
  if (header.has("ElementNumberOfChannels") && header.text("ElementNumberOfChannels") != "1")
    header.refuse("ElementNumberOfChannels", "1 is read");
}

/// The data's file, named relative to the header's folder.
std::string read_data_file(const std::string& path, const TextHeader& header) {
  const std::string name = header.text("ElementDataFile");
  if (name == "LIST" || name.find('%') != std::string::npos)
    header.refuse("ElementDataFile", "LOCAL or a single file is read");
  const std::filesystem::path file = std::filesystem::path(path).parent_path() / name;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file) || !stream)
    header.refuse("ElementDataFile", "it cannot be read from '" + file.string() + "'");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Bytes before the data in its file; −1: the data is the file's end.
std::size_t skipped_bytes(const TextHeader& header, std::size_t available, std::size_t needed) {
  if (!header.has("HeaderSize")) return 0;
  std::istringstream text(header.text("HeaderSize"));
  std::int64_t bytes = 0;
  if (!(text >> bytes) || bytes < -1) header.refuse("HeaderSize", "a number of bytes, or -1, is needed");
  if (bytes >= 0) return static_cast<std::size_t>(bytes);
  return available > needed ? available - needed : 0;
}

}  // namespace

bool is_meta_image(const std::string& content) {
  for (const std::string first_key : {"ObjectType", "NDims", "Comment"})
    if (content.compare(0, first_key.size(), first_key) == 0) return true;
  return false;
}

LabelImage read_meta_image(const std::string& path, const std::string& content) {
  std::size_t data = 0;
  const TextHeader header = parse_header(path, content, data);
  check_kind(header);
  LabelImage image;
  image.size = header.three_numbers("DimSize").cast<int>();
  image.spacing =
      unit_of_length(header) * header.three_numbers(used_name(header, {"ElementSpacing", "ElementSize"}));
  check_image_geometry(path, image);
  const PixelFormat format = pixel_format(header);

  const bool local = header.text("ElementDataFile") == "LOCAL";
  std::string bytes = local ? content.substr(data) : read_data_file(path, header);
  const std::size_t needed = format.bytes * image.size.cast<std::size_t>().prod();
  const std::size_t skipped = local ? 0 : skipped_bytes(header, bytes.size(), needed);
  if (is_true(header, "CompressedData"))
    image.labels = decode_labels(path, inflate_from(path, bytes, skipped), 0, image.size, format);
  else
    image.labels = decode_labels(path, bytes, skipped, image.size, format);
  apply_axes(path, axes_of(header), image);
  return image;
}

}  // namespace cfem_cutting
