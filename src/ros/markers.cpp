#include "cfem_cutting/ros/markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "cfem_cutting/ros/conversions.h"
#include "shading.h"

namespace cfem_cutting {
namespace {

using visualization_msgs::Marker;

constexpr double kBladeHeight = 0.008;    // m, edge to spine as drawn
constexpr double kArrowPerNewton = 0.05;  // m/N
constexpr double kLongestArrow = 0.1;     // m
constexpr double kSmallestForce = 1e-4;   // N, drawn

std_msgs::ColorRGBA colour(double r, double g, double b) {
  std_msgs::ColorRGBA rgba;
  rgba.r = static_cast<float>(r);
  rgba.g = static_cast<float>(g);
  rgba.b = static_cast<float>(b);
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

// A marker like the given one for each label with a colour of its own, after that for all others.
std::vector<Marker> colour_by_label(const Marker& others, const SurfaceConfig& look) {
  std::vector<Marker> markers{others};
  for (const auto& [label, rgb] : look.label_colours) {
    markers.push_back(others);
    markers.back().id = static_cast<int>(MarkerId::kFirstLabel) + label;
    markers.back().color = colour(rgb.x(), rgb.y(), rgb.z());
  }
  return markers;
}

// For each label its place among those markers, −1 if it is hidden.
std::array<int, 256> places_of_labels(const SurfaceConfig& look) {
  std::array<int, 256> places{};
  for (std::size_t n = 0; n < look.label_colours.size(); ++n)
    places[look.label_colours[n].label] = static_cast<int>(n) + 1;
  for (const int label : look.hidden_labels) places[label] = -1;
  return places;
}

// Triangles with the given flag; a vertex that is not a number leaves its triangles out.
void add_triangles(const DeformedSurface& surface, bool cut, const Marker& others, const SurfaceConfig& look,
                   std::vector<Marker>& all) {
  std::vector<Marker> markers = colour_by_label(others, look);
  const std::array<int, 256> places = places_of_labels(look);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const int place = places[surface.label[t]];
    if ((surface.cut[t] != 0) != cut || place < 0) continue;
    const std::array<int, 3>& corners = surface.triangles[t];
    const auto& p = surface.positions;
    if (!p[corners[0]].allFinite() || !p[corners[1]].allFinite() || !p[corners[2]].allFinite()) continue;
    Marker& marker = markers[place];
    for (int corner : corners) marker.points.push_back(to_point(p[corner]));
    if (look.shading == Shading::kFlat) continue;
    const Vec3 normal = (p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]]).normalized();
    for (int corner : corners)
      marker.colors.push_back(shade(marker.color, shading_normal(surface.normals[corner], normal)));
  }
  for (Marker& marker : markers) delete_if_empty(marker);
  std::move(markers.begin(), markers.end(), std::back_inserter(all));
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

visualization_msgs::MarkerArray to_markers(const Scene& scene, const std::string& frame,
                                           const SurfaceConfig& look) {
  const std_msgs::Header header = make_header(frame, scene.time);
  Marker skin = make_marker(MarkerId::kSkin, "skin", Marker::TRIANGLE_LIST, header);
  Marker cut_faces = make_marker(MarkerId::kCutFaces, "cut_faces", Marker::TRIANGLE_LIST, header);
  Marker blade = make_marker(MarkerId::kBlade, "blade", Marker::TRIANGLE_LIST, header);
  Marker force = make_marker(MarkerId::kForce, "force", Marker::ARROW, header);
  skin.color = colour(0.54, 0.16, 0.13);
  cut_faces.color = colour(0.88, 0.36, 0.34);
  blade.color = colour(0.75, 0.78, 0.82);
  force.color = colour(0.10, 0.45, 0.85);
  add_blade(scene.front, blade);
  add_force(scene, force);
  visualization_msgs::MarkerArray markers;
  markers.markers = {blade, force};
  add_triangles(scene.surface, false, skin, look, markers.markers);
  add_triangles(scene.surface, true, cut_faces, look, markers.markers);
  return markers;
}

}  // namespace cfem_cutting
