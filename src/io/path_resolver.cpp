#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/config_reader.h"

namespace cfem_cutting {
namespace {

namespace fs = std::filesystem;

const std::string kFile = "file://", kPackage = "package://";
constexpr int kWorkspaceDepth = 4;

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool holds_package(const fs::path& folder, const std::string& name) {
  std::ifstream file(folder / "package.xml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str().find("<name>" + name + "</name>") != std::string::npos;
}

/// The package's folder at or below another.
fs::path find_below(const fs::path& folder, const std::string& name, int depth) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  if (fs::exists(folder / "package.xml", ignored)) return holds_package(folder, name) ? folder : fs::path();
  if (depth == 0) return {};
  if (holds_package(folder / name, name)) return folder / name;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path found =
        entry.is_directory(ignored) ? find_below(entry.path(), name, depth - 1) : fs::path();
    if (!found.empty()) return found;
  }
  return {};
}

fs::path find_above(fs::path folder, const std::string& name) {
  for (; !folder.empty(); folder = folder.parent_path()) {
    if (holds_package(folder, name)) return folder;
    if (folder == folder.root_path()) break;
  }
  return {};
}

fs::path find_package(const std::string& name, const fs::path& config_folder) {
  const fs::path above = find_above(config_folder, name);
  if (!above.empty()) return above;
  const char* variable = std::getenv("ROS_PACKAGE_PATH");
  std::stringstream folders(variable ? variable : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = find_below(folder, name, kWorkspaceDepth);
    if (!found.empty()) return found;
  }
  return {};
}

std::string resolve(const std::string& uri, const fs::path& config_folder) {
  if (starts_with(uri, kFile)) return uri.substr(kFile.size());
  if (starts_with(uri, kPackage)) {
    const std::string rest = uri.substr(kPackage.size());
    const std::string name = rest.substr(0, rest.find('/'));
    const fs::path package = find_package(name, config_folder);
    if (package.empty()) throw FileError(uri + ": no package '" + name + "' in ROS_PACKAGE_PATH");
    return (package.string() + rest.substr(name.size()));
  }
  const fs::path path(uri);
  const bool beside_config = path.is_relative() && !fs::exists(path) && fs::exists(config_folder / path);
  return beside_config ? (config_folder / path).string() : uri;
}

}  // namespace

PathResolver make_path_resolver(const std::string& config_path) {
  const fs::path folder = fs::absolute(config_path).lexically_normal().parent_path();
  return [folder](const std::string& uri) { return resolve(uri, folder); };
}

}  // namespace cfem_cutting
