#include "cfem_cutting/io/output_folder.h"

#include <algorithm>
#include <regex>
#include <vector>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

namespace fs = std::filesystem;

const std::string kSummary = "summary.json";

fs::path without_trailing_slash(const std::string& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

bool is_result(const std::string& name) {
  static const std::regex results(
      R"((steps|events|front|probes|links|timing)\.csv|(summary|timing)\.json|surface_(final|rest|\d{4,})\.ply)");
  return std::regex_match(name, results);
}

/// What a run that was ended left is removed, but nothing else.
void refuse_foreign_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw FileError(folder.string() + ": is a file: must be absent");
  for (const auto& entry : fs::directory_iterator(folder))
    if (!is_result(entry.path().filename().string()))
      throw FileError(folder.string() + ": holds " + entry.path().filename().string() +
                      ", which is no result: must be absent, results are written there first");
}

void remove_results(const fs::path& folder) {
  fs::remove(folder / kSummary);  // first, so that what is left does not look whole
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_result(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove(path);
}

void move_results(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(from)) files.push_back(entry.path());
  std::stable_partition(files.begin(), files.end(),
                        [](const fs::path& p) { return p.filename() != kSummary; });
  for (const fs::path& path : files) fs::rename(path, to / path.filename());
  fs::remove(from);
}

}  // namespace

OutputFolder::OutputFolder(const std::string& path) : whole_(without_trailing_slash(path)) {
  partial_ = whole_;
  partial_ += ".partial";
  if (fs::exists(whole_) && !fs::is_directory(whole_))
    throw FileError(path + ": is a file: must be a folder");
  std::error_code error;
  if (fs::exists(partial_)) refuse_foreign_files(partial_);
  fs::remove_all(partial_, error);
  if (!error) fs::create_directories(partial_, error);
  if (error) throw FileError(partial_.string() + ": cannot be made: " + error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!kept_) fs::remove_all(partial_, ignored);
}

std::string OutputFolder::keep() {
  kept_ = true;
  return partial_.string();
}

std::ofstream OutputFolder::create(const std::string& name) const {
  std::ofstream stream(file(name), std::ios::binary);
  if (!stream) throw FileError(file(name) + ": cannot be written");
  return stream;
}

void OutputFolder::publish() try {
  if (!fs::exists(whole_)) return fs::rename(partial_, whole_);
  remove_results(whole_);
  move_results(partial_, whole_);
} catch (const fs::filesystem_error& error) {
  throw FileError(whole_.string() + ": cannot be written: " + error.code().message());
}

void close_checked(std::ofstream& file, const std::string& name) {
  file.close();
  if (!file) throw FileError(name + ": cannot be written as a whole");
}

}  // namespace cfem_cutting
