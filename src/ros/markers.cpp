#include "cfem_cutting/ros/markers.h"

#include <cmath>

#include "cfem_cutting/ros/conversions.h"

namespace cfem_cutting {
namespace {

using visualization_msgs::Marker;

constexpr double kBladeHeight = 0.008;    // m, edge to spine as drawn
constexpr double kArrowPerNewton = 0.05;  // m/N
constexpr double kLongestArrow = 0.1;     // m
constexpr double kSmallestForce = 1e-4;   // N, drawn

std_msgs::ColorRGBA colour(float r, float g, float b) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = 1.0f;
  return rgba;
}

Marker make_marker(MarkerId id, const std::string& name, int type, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.id = static_cast<int>(id);
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  return marker;
}

void delete_if_empty(Marker& marker) {
  if (marker.points.empty()) marker.action = Marker::DELETE;
}

// Triangles with the given flag; a vertex that is not a number leaves its triangles out.
void add_triangles(const DeformedSurface& surface, bool cut, Marker& marker) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if ((surface.cut[t] != 0) != cut) continue;
    const std::array<int, 3>& corners = surface.triangles[t];
    const auto& p = surface.positions;
    if (!p[corners[0]].allFinite() || !p[corners[1]].allFinite() || !p[corners[2]].allFinite()) continue;
    for (int corner : corners) marker.points.push_back(to_point(p[corner]));
  }
  delete_if_empty(marker);
}

// The blade as a flat wedge: both sides between the edge and a line above it.
void add_blade(const Front& front, Marker& marker) {
  for (std::size_t i = 0; i + 1 < front.points.size(); ++i) {
    const Vec3 &a = front.points[i], &b = front.points[i + 1];
    const Vec3 c = b + kBladeHeight * front.back, d = a + kBladeHeight * front.back;
    for (const Vec3& p : {a, b, c, a, c, d, a, c, b, a, d, c}) marker.points.push_back(to_point(p));
  }
  delete_if_empty(marker);
}

// An arrow from the middle of the contacts along the force on the tool.
void add_force(const Scene& scene, Marker& marker) {
  marker.scale.x = 0.002;
  marker.scale.y = 0.005;
  marker.scale.z = 0.008;
  const double newtons = scene.spatial.force.norm();
  if (scene.contacts.empty() || !(newtons > kSmallestForce)) return delete_if_empty(marker);
  Vec3 start = Vec3::Zero();
  for (const ContactForce& contact : scene.contacts) start += contact.point / scene.contacts.size();
  const Vec3 arrow = scene.spatial.force / newtons * std::min(kLongestArrow, kArrowPerNewton * newtons);
  marker.points = {to_point(start), to_point(start + arrow)};
}

}  // namespace

visualization_msgs::MarkerArray to_markers(const Scene& scene, const std::string& frame) {
  const std_msgs::Header header = make_header(frame, scene.time);
  Marker skin = make_marker(MarkerId::kSkin, "skin", Marker::TRIANGLE_LIST, header);
  Marker cut_faces = make_marker(MarkerId::kCutFaces, "cut_faces", Marker::TRIANGLE_LIST, header);
  Marker blade = make_marker(MarkerId::kBlade, "blade", Marker::TRIANGLE_LIST, header);
  Marker force = make_marker(MarkerId::kForce, "force", Marker::ARROW, header);
  skin.color = colour(0.45f, 0.13f, 0.10f);
  cut_faces.color = colour(0.88f, 0.36f, 0.34f);
  blade.color = colour(0.75f, 0.78f, 0.82f);
  force.color = colour(0.10f, 0.45f, 0.85f);
  add_triangles(scene.surface, false, skin);
  add_triangles(scene.surface, true, cut_faces);
  add_blade(scene.front, blade);
  add_force(scene, force);
  visualization_msgs::MarkerArray markers;
  markers.markers = {skin, cut_faces, blade, force};
  return markers;
}

}  // namespace cfem_cutting
