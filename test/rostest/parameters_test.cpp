// Every shipped configuration says the same through the parameter server as from its file.

#include "cfem_cutting/ros/parameters.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <filesystem>

namespace cfem_cutting {
namespace {

/// Equal up to the way that numbers are written.
bool same_scalar(const YAML::Node& a, const YAML::Node& b) {
  double x = 0.0, y = 0.0;
  if (YAML::convert<double>::decode(a, x) && YAML::convert<double>::decode(b, y)) return x == y;
  return a.Scalar() == b.Scalar();
}

void expect_same(const YAML::Node& a, const YAML::Node& b, const std::string& key) {
  ASSERT_EQ(a.Type(), b.Type()) << key;
  if (a.IsScalar()) {
    EXPECT_TRUE(same_scalar(a, b)) << key << ": " << a.Scalar() << " and " << b.Scalar();
  }
  ASSERT_EQ(a.size(), b.size()) << key;
  if (a.IsSequence())
    for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i], key + "[" + std::to_string(i) + "]");
  if (a.IsMap())
    for (const auto& member : a) {
      const auto name = member.first.as<std::string>();
      ASSERT_TRUE(b[name]) << key << "." << name;
      expect_same(member.second, b[name], key + "." + name);
    }
}

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(CFEM_CUTTING_SOURCE_DIR "/config"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  return files;
}

TEST(Parameters, SayTheSameAsTheFiles) {
  ASSERT_GE(shipped().size(), 3u);
  for (const auto& file : shipped()) {
    const std::string parameter = "/shipped/" + file.stem().string();
    XmlRpc::XmlRpcValue value;
    ASSERT_TRUE(ros::param::get(parameter, value)) << parameter << " is not loaded by parameters.test";
    expect_same(to_yaml(value), YAML::LoadFile(file), file.stem());
    const Config config = read_parameters(ros::NodeHandle(parameter));
    const Config expected = read_config_file(file, {});
    EXPECT_EQ(config.simulation.tissue.source, expected.simulation.tissue.source);
    EXPECT_EQ(config.simulation.tissue.voxel_size, expected.simulation.tissue.voxel_size);
    EXPECT_EQ(config.simulation.fracture.onset_offset, expected.simulation.fracture.onset_offset);
    EXPECT_EQ(config.simulation.blade.edge, expected.simulation.blade.edge);
    EXPECT_EQ(config.simulation.tissue.fixed.size(), expected.simulation.tissue.fixed.size());
  }
}

}  // namespace
}  // namespace cfem_cutting

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_parameters");
  const ros::NodeHandle node;  // so that ROS is up
  return RUN_ALL_TESTS();
}
