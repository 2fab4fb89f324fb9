#pragma once

#include <map>
#include <string>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// The fields of a label image's text header.
class TextHeader {
 public:
  /// @param format what the messages call it: NRRD, say
  TextHeader(std::string path, std::string format) : path_(std::move(path)), format_(std::move(format)) {}

  void set(const std::string& key, const std::string& value) { fields_[key] = value; }
  bool has(const std::string& key) const { return fields_.count(key) > 0; }
  /// @return empty for a field that is not there
  std::string text(const std::string& key) const;

  /// @throw FileError fewer than three numbers
  Vec3 three_numbers(const std::string& key) const;

  /// @throw FileError always: file, field, value, rule
  [[noreturn]] void refuse(const std::string& key, const std::string& rule) const;

 private:
  std::string path_, format_;
  std::map<std::string, std::string> fields_;
};

}  // namespace cfem_cutting
