#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/io/files.h"

namespace cfem_cutting {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool ends_with_any(std::string path, const std::vector<std::string>& ends) {
  std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(ends.begin(), ends.end(), [&](const std::string& end) { return ends_with(path, end); });
}

/// Source to tissue; fixed axes x, y, z as in URDF.
Pose placement(const TissueConfig& tissue) {
  return Eigen::Translation3d(tissue.xyz) * Eigen::AngleAxisd(tissue.rpy.z(), Vec3::UnitZ()) *
         Eigen::AngleAxisd(tissue.rpy.y(), Vec3::UnitY()) * Eigen::AngleAxisd(tissue.rpy.x(), Vec3::UnitX());
}

void check_source(const std::string& path) {
  const std::string why = why_unreadable(path);
  if (why.empty()) return;
  const bool is_fetched = std::filesystem::path(path).parent_path().filename() == "data";
  throw FileError("tissue.source: " + path + ": cannot be read: " + why +
                  (is_fetched ? " (scripts/fetch_data gets the package's data)" : ""));
}

std::string read_text(const std::string& path) {
  check_readable(path);
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

std::unique_ptr<Shape> load_shape(const TissueConfig& tissue, const PathResolver& resolve) {
  const Pose X_TS = placement(tissue);
  if (tissue.source == "box") return make_box(tissue.box_size, X_TS);
  const bool is_image =
      ends_with_any(tissue.source, {".inr", ".inr.gz", ".nrrd", ".nii", ".nii.gz", ".mha", ".mhd"});
  if (!is_image && !ends_with_any(tissue.source, {".stl", ".obj", ".ply", ".off"}))
    throw FileError(
        "tissue.source: " + tissue.source +
        ": must be box or end in .stl, .obj, .ply, .off, .inr, .inr.gz, .nrrd, .nii, .nii.gz, .mha or .mhd");
  const std::string path = resolve(tissue.source);
  check_source(path);
  if (is_image) return make_label_shape(read_label_image(path), tissue.labels, X_TS, path);
  return make_mesh_shape(read_mesh(path), tissue.scale, X_TS, path);
}

Blade load_blade(const BladeConfig& blade, const PathResolver& resolve,
                 const std::string& robot_description) {
  if (!blade.edge.empty()) return make_blade(blade.edge, blade.back, blade.friction);
  if (blade.edge_links.empty())
    throw ConfigError("blade: is missing: must hold exactly one of edge and edge_links");
  const std::string urdf = blade.urdf.empty() ? robot_description : read_text(resolve(blade.urdf));
  if (urdf.empty())
    throw ConfigError("blade.urdf: is empty: must name a URDF, in which edge_links are found");
  return make_blade(edge_from_urdf(urdf, blade.tool_link, blade.edge_links), blade.back, blade.friction);
}

}  // namespace cfem_cutting
