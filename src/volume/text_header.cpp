#include "text_header.h"

#include <sstream>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {

std::string TextHeader::text(const std::string& key) const {
  const auto field = fields_.find(key);
  return field == fields_.end() ? "" : field->second;
}

Vec3 TextHeader::three_numbers(const std::string& key) const {
  std::istringstream numbers(text(key));
  Vec3 vector;
  if (!(numbers >> vector.x() >> vector.y() >> vector.z())) refuse(key, "three numbers are needed");
  return vector;
}

void TextHeader::refuse(const std::string& key, const std::string& rule) const {
  throw FileError("label image '" + path_ + "': " + format_ + " field " + key + " is " +
                  (has(key) ? "'" + text(key) + "'" : "missing") + "; " + rule);
}

}  // namespace cfem_cutting
