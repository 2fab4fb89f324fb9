#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace cfem_cutting {

/// A folder of results that is whole or not there: files are written beside it and moved in at the end.
class OutputFolder {
 public:
  /// @throw FileError the path is a file, or nothing can be written there
  explicit OutputFolder(const std::string& path);
  /// Removes what was neither published nor kept.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write a file.
  std::string file(const std::string& name) const { return (partial_ / name).string(); }

  /// @throw FileError
  std::ofstream create(const std::string& name) const;

  /// Puts the files in place of those of an earlier run; other files in the folder stay. The summary goes
  /// last.
  /// @throw FileError
  void publish();

  /// Leaves the files where they were written, until the next run with this path.
  /// @return where that is
  std::string keep();

 private:
  std::filesystem::path whole_;
  std::filesystem::path partial_;
  bool kept_ = false;
};

/// Closes a written file.
/// @throw FileError it could not be written as a whole, as on a full disk
void close_checked(std::ofstream& file, const std::string& name);

}  // namespace cfem_cutting
