#include <gtest/gtest.h>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& origin) {
  return "<joint name='" + parent + "_" + child + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin " + origin +
         "/><axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/></joint>";
}

/// flange → tool (turned a quarter about z) → heel; flange → tip; the heel's neighbour `guard` slides.
const std::string kScalpel =
    "<robot name='scalpel'><link name='flange'/><link name='tool'/><link name='heel'/><link name='tip'/>"
    "<link name='guard'/>" +
    joint("fixed", "flange", "tool", "xyz='0 0 0.1' rpy='0 0 1.5707963267948966'") +
    joint("fixed", "tool", "heel", "xyz='0.01 0 0' rpy='0 0 0'") +
    joint("fixed", "flange", "tip", "xyz='0 0.04 0.1' rpy='0 0 0'") +
    joint("prismatic", "tool", "guard", "xyz='0.02 0 0' rpy='0 0 0'") + "</robot>";

std::string refusal(const std::string& xml, const std::string& tool, const std::string& link) {
  try {
    edge_from_urdf(xml, tool, {link});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(EdgeFromUrdf, LinksBelowTheToolAndBesideIt) {
  const Polyline edge = edge_from_urdf(kScalpel, "tool", {"heel", "tip"});
  ASSERT_EQ(edge.size(), 2u);
  EXPECT_TRUE(edge[0].isApprox(Vec3(0.01, 0.0, 0.0), 1e-12));
  EXPECT_TRUE(edge[1].isApprox(Vec3(0.04, 0.0, 0.0), 1e-12));
}

TEST(EdgeFromUrdf, MissingLinksAreNamed) {
  EXPECT_EQ(refusal(kScalpel, "tool", "point"),
            "blade.edge_links: point: the URDF 'scalpel' has no such link");
  EXPECT_EQ(refusal(kScalpel, "knife", "heel"),
            "blade.tool_link: knife: the URDF 'scalpel' has no such link");
}

TEST(EdgeFromUrdf, MovingJointsAreRefusedEitherWay) {
  EXPECT_EQ(refusal(kScalpel, "tool", "guard"),
            "blade.edge_links: guard: must be joined to tool by fixed joints, not by 'tool_guard'");
  EXPECT_EQ(refusal(kScalpel, "guard", "tip"),
            "blade.edge_links: tip: must be joined to guard by fixed joints, not by 'tool_guard'");
}

TEST(EdgeFromUrdf, WhatIsNoUrdfIsRefused) {
  EXPECT_EQ(refusal("steel", "tool", "heel"), "blade.urdf: the document is not a URDF");
}

}  // namespace
}  // namespace cfem_cutting
