#include "cfem_cutting/io/poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <utility>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/files.h"
#include "cfem_cutting/io/number.h"

namespace cfem_cutting {
namespace {

const std::array<std::string, 8> kColumns{"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr double kShortestQuaternion = 1e-6;

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells{""};
  for (char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// A line of the file, and where it stands.
struct Line {
  std::string place;  // file:line
  std::vector<std::string> cells;
};

StampedPose read_pose(const Line& line) {
  if (line.cells.size() != kColumns.size())
    throw FileError(line.place + ": " + std::to_string(line.cells.size()) +
                    " columns: must be 8, t,x,y,z,qx,qy,qz,qw");
  std::array<double, 8> v{};
  for (std::size_t c = 0; c < v.size(); ++c)
    if (!parse_number(line.cells[c], v[c]))
      throw FileError(line.place + ": column " + kColumns[c] + ": '" + line.cells[c] +
                      "': must be a finite number");
  for (int c = 1; c <= 3; ++c)
    if (std::abs(v[c]) > kFarthestPosition)
      throw FileError(line.place + ": column " + kColumns[c] + ": " + line.cells[c] + " m: must be within " +
                      format_number(kFarthestPosition) + " m");
  const Eigen::Quaterniond rotation(v[7], v[4], v[5], v[6]);
  if (rotation.norm() < kShortestQuaternion)
    throw FileError(line.place + ": columns qx,qy,qz,qw: 0,0,0,0: must be a rotation, not zero");
  return {v[0], Eigen::Translation3d(v[1], v[2], v[3]) * rotation.normalized()};
}

void check_header(const Line& line) {
  if (!std::equal(kColumns.begin(), kColumns.end(), line.cells.begin(), line.cells.end()))
    throw FileError(line.place + ": the first line must be t,x,y,z,qx,qy,qz,qw");
}

}  // namespace

PoseTrack read_poses_csv(const std::string& path) {
  check_readable(path);
  std::ifstream file(path);
  PoseTrack track;
  std::string text;
  bool header = false;
  for (int number = 1; std::getline(file, text); ++number) {
    if (trimmed(text).empty()) continue;
    const Line line{path + ":" + std::to_string(number), split(text)};
    if (!std::exchange(header, true)) {
      check_header(line);
      continue;
    }
    track.push_back(read_pose(line));
    const double time = track.back().time;
    if (track.size() > 1 && time <= track[track.size() - 2].time)
      throw FileError(line.place + ": column t: " + format_number(time) +
                      ": must be later than the line before, " + format_number(track[track.size() - 2].time));
  }
  if (track.empty()) throw FileError(path + ": holds no poses");
  return track;
}

Pose pose_at(const PoseTrack& track, double time) {
  const auto after = std::lower_bound(track.begin(), track.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.time < t; });
  if (after == track.begin()) return track.front().pose;
  if (after == track.end()) return track.back().pose;
  const StampedPose& before = *(after - 1);
  return interpolate(before.pose, after->pose, (time - before.time) / (after->time - before.time));
}

}  // namespace cfem_cutting
