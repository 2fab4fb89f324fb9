#include "cfem_cutting/ros/markers.h"

#include <gtest/gtest.h>

namespace cfem_cutting {
namespace {

using visualization_msgs::Marker;

/// Triangles of the labels 1, 2, 3 in the skin and 1, 2 in cut faces; those of label n lie at z = n.
Scene scene() {
  Scene scene;
  DeformedSurface& surface = scene.surface;
  const std::vector<std::pair<int, int>> triangles{{1, 0}, {2, 0}, {3, 0}, {1, 1}, {2, 1}};
  for (const auto& [label, cut] : triangles) {
    const int first = static_cast<int>(surface.positions.size());
    for (const Vec3& p : {Vec3(0, 0, label), Vec3(1, 0, label), Vec3(0, 1, label)})
      surface.positions.push_back(p);
    surface.triangles.push_back({first, first + 1, first + 2});
    surface.normals.insert(surface.normals.end(), 3, Vec3::UnitZ());
    surface.label.push_back(static_cast<std::uint8_t>(label));
    surface.cut.push_back(static_cast<std::uint8_t>(cut));
  }
  return scene;
}

/// Heights of a marker's triangles, −1 if it is to be deleted.
std::vector<double> heights(const visualization_msgs::MarkerArray& array, const std::string& name, int id) {
  for (const Marker& marker : array.markers) {
    if (marker.ns != name || marker.id != id) continue;
    if (marker.action == Marker::DELETE) return {-1.0};
    std::vector<double> heights;
    for (std::size_t n = 0; n < marker.points.size(); n += 3) heights.push_back(marker.points[n].z);
    return heights;
  }
  return {};
}

using Heights = std::vector<double>;

TEST(Markers, ShareColoursUnlessLabelsHaveTheirOwn) {
  const auto array = to_markers(scene(), "tissue", {});
  EXPECT_EQ(array.markers.size(), 4u);
  EXPECT_EQ(heights(array, "skin", 0), (Heights{1, 2, 3}));
  EXPECT_EQ(heights(array, "cut_faces", 1), (Heights{1, 2}));
}

TEST(Markers, OfALabelWithAColourStandAlone) {
  SurfaceConfig look;
  look.label_colours = {{2, {0.1, 0.2, 0.3}}, {3, {1, 1, 1}}};
  const auto array = to_markers(scene(), "tissue", look);
  EXPECT_EQ(heights(array, "skin", 0), Heights{1});
  EXPECT_EQ(heights(array, "skin", 12), Heights{2});
  EXPECT_EQ(heights(array, "skin", 13), Heights{3});
  EXPECT_EQ(heights(array, "cut_faces", 1), Heights{1});
  EXPECT_EQ(heights(array, "cut_faces", 12), Heights{2});
  EXPECT_EQ(heights(array, "cut_faces", 13), Heights{-1});
  for (const Marker& marker : array.markers) {
    EXPECT_TRUE(marker.colors.empty()) << "rviz lights markers of one colour only";
    EXPECT_EQ(marker.color.a, 1.0f);
    if (marker.id == 12) {
      EXPECT_EQ(std::vector<float>({marker.color.r, marker.color.g, marker.color.b}),
                std::vector<float>({0.1f, 0.2f, 0.3f}));
    }
  }
}

TEST(Markers, OfHiddenLabelsAreDeleted) {
  SurfaceConfig look;
  look.label_colours = {{2, {0.1, 0.2, 0.3}}};
  look.hidden_labels = {1, 2};
  const auto array = to_markers(scene(), "tissue", look);
  EXPECT_EQ(heights(array, "skin", 0), Heights{3});
  EXPECT_EQ(heights(array, "skin", 12), Heights{-1});
  EXPECT_EQ(heights(array, "cut_faces", 1), Heights{-1});
  EXPECT_EQ(heights(array, "cut_faces", 12), Heights{-1});
}

TEST(Markers, OfSmoothShadingAreBrighterWhereNormalsPointUp) {
  Scene shown = scene();
  for (std::size_t v = 0; v < 3; ++v) shown.surface.normals[v] = -Vec3::UnitZ();  // of the first triangle
  SurfaceConfig look;
  look.shading = Shading::kSmooth;
  look.label_colours = {{3, {1, 1, 1}}};
  for (const Marker& marker : to_markers(shown, "tissue", look).markers) {
    if (marker.ns != "skin" && marker.ns != "cut_faces") continue;
    ASSERT_EQ(marker.colors.size(), marker.points.size()) << marker.ns << " " << marker.id;
    for (const auto& colour : marker.colors) {
      EXPECT_EQ(colour.a, 1.0f);
      for (const float part : {colour.r, colour.g, colour.b}) EXPECT_TRUE(part > 0.0f && part <= 1.0f);
    }
    if (marker.ns == "skin" && marker.id == 0) EXPECT_LT(2.0f * marker.colors[0].r, marker.colors[3].r);
  }
}

}  // namespace
}  // namespace cfem_cutting
