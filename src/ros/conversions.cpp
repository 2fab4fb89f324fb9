#include "cfem_cutting/ros/conversions.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "cfem_cutting/io/number.h"
#include "cfem_cutting/io/poses.h"

namespace cfem_cutting {
namespace {

constexpr double kUnitTolerance = 0.01;  // of a quaternion's length

std::string list_of(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + format_number(number);
  return "[" + text + "]";
}

template <typename Position, typename Rotation>
std::string find_fault(const Position& p, const Rotation& q) {
  if (!(Vec3(p.x, p.y, p.z).array().abs() <= kFarthestPosition).all())  // nor NaN
    return "position " + list_of({p.x, p.y, p.z}) + " m: must be finite and within " +
           format_number(kFarthestPosition) + " m";
  const double length = Eigen::Vector4d(q.x, q.y, q.z, q.w).norm();
  if (!(std::abs(length - 1.0) <= kUnitTolerance))
    return "quaternion " + list_of({q.x, q.y, q.z, q.w}) + " (x, y, z, w): must be of length 1, to 1 %";
  return "";
}

template <typename Position, typename Rotation>
bool read_pose(const Position& p, const Rotation& q, Pose& pose) {
  if (!find_fault(p, q).empty()) return false;
  pose = Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
  return true;
}

void append(const std::vector<Vec3>& vectors, std::vector<float>& out) {
  out.reserve(out.size() + 3 * vectors.size());
  for (const Vec3& v : vectors) {
    for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
  }
}

}  // namespace

std_msgs::Header make_header(const std::string& frame, double time) {
  constexpr double latest = std::numeric_limits<std::uint32_t>::max();
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp.fromSec(std::clamp(time, 0.0, latest));
  return header;
}

geometry_msgs::Point to_point(const Vec3& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

geometry_msgs::Vector3 to_vector(const Vec3& v) {
  geometry_msgs::Vector3 vector;
  vector.x = v.x();
  vector.y = v.y();
  vector.z = v.z();
  return vector;
}

geometry_msgs::Wrench to_wrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = to_vector(wrench.force);
  message.torque = to_vector(wrench.moment);
  return message;
}

geometry_msgs::Transform to_transform(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Transform transform;
  transform.translation = to_vector(pose.translation());
  transform.rotation.x = q.x();
  transform.rotation.y = q.y();
  transform.rotation.z = q.z();
  transform.rotation.w = q.w();
  return transform;
}

bool to_pose(const geometry_msgs::Pose& message, Pose& pose) {
  return read_pose(message.position, message.orientation, pose);
}

bool to_pose(const geometry_msgs::Transform& message, Pose& pose) {
  return read_pose(message.translation, message.rotation, pose);
}

std::string fault_of(const geometry_msgs::Pose& message) {
  return find_fault(message.position, message.orientation);
}

std::string fault_of(const geometry_msgs::Transform& message) {
  return find_fault(message.translation, message.rotation);
}

std::string frame_name(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

FractureEventMessage to_message(const FractureEvent& event, const std::string& frame) {
  FractureEventMessage message;
  message.header = make_header(frame, event.time);
  message.unit = event.unit;
  message.links_severed = event.links_severed;
  message.area = event.area;
  message.largest_offset = event.largest_offset;
  message.fracture_work = event.fracture_work;
  message.blade_work = event.blade_work;
  message.peak_force = event.peak_force;
  message.centroid = to_point(event.centroid);
  message.normal = to_vector(event.normal);
  for (const Vec3& p : event.front) message.front.push_back(to_point(p));
  message.pieces = static_cast<std::uint32_t>(event.piece_volumes.size());
  message.piece_volumes = event.piece_volumes;
  message.separated = event.separated;
  return message;
}

ContactForces to_contact_forces(const StepReport& report, const std::string& frame) {
  ContactForces message;
  message.header = make_header(frame, report.time);
  for (const ContactForce& contact : report.contacts) {
    message.kind.push_back(ContactForces::EDGE);
    message.points.push_back(to_point(contact.point));
    message.forces.push_back(to_vector(contact.force));
  }
  return message;
}

StepReportMessage to_message(const StepReport& report, const std::string& frame, double lag, double skipped) {
  StepReportMessage message;
  message.header = make_header(frame, report.time);
  message.phase = static_cast<std::uint8_t>(report.phase);
  message.unit = report.unit;
  message.largest_offset = report.largest_offset;
  message.candidates = report.candidates;
  message.links_severed = report.links_severed;
  message.cut_area = report.cut_area;
  message.pieces = report.pieces;
  message.solver_iterations = static_cast<std::uint16_t>(std::clamp(report.iterations, 0, 65535));
  message.solver_residual = report.residual;
  message.lag = lag;
  message.skipped = skipped;
  for (const StageTime& stage : report.stages) {
    message.stages.push_back(stage.stage);
    message.milliseconds.push_back(stage.milliseconds);
  }
  return message;
}

SurfaceMesh to_message(const DeformedSurface& surface, const std::vector<double>& scalars,
                       const std_msgs::Header& header) {
  SurfaceMesh message;
  message.header = header;
  append(surface.positions, message.vertices);
  append(surface.normals, message.normals);
  message.scalars.assign(scalars.begin(), scalars.end());
  message.triangles.reserve(3 * surface.triangles.size());
  for (const std::array<int, 3>& triangle : surface.triangles) {
    message.triangles.insert(message.triangles.end(), triangle.begin(), triangle.end());
  }
  message.cut = surface.cut;
  return message;
}

}  // namespace cfem_cutting
