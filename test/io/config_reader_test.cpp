#include "cfem_cutting/io/config_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "cfem_cutting/geometry/errors.h"
#include "io/config_rejections.h"

namespace cfem_cutting {
namespace {

const std::string kBlade = "blade: {edge: [[0, 0, 0], [0.03, 0, 0]]}\n";

std::string refusal(const std::string& yaml) try {
  read_config(YAML::Load(yaml));
  return "";
} catch (const ConfigError& error) {
  return error.what();
}

TEST(ConfigReader, RefusesBadValuesByKeyAndRule) {
  for (const Rejection& rejection : rejections())
    EXPECT_EQ(refusal(rejection.yaml).rfind(rejection.message, 0), 0u)
        << rejection.yaml << " → '" << refusal(rejection.yaml) << "'";
}

TEST(ConfigReader, EveryKeyHasARejectionTest) {
  std::set<std::string> tested;
  for (const Rejection& rejection : rejections()) tested.insert(rejection.schema_key);
  for (const KeyDoc& key : schema()) EXPECT_EQ(tested.count(key.key), 1u) << key.key;
}

TEST(ConfigReader, NamesUnknownKeysAndTheNearestKnownOne) {
  EXPECT_EQ(refusal("tissue: {scal: 1}"), "tissue.scal: unknown key; did you mean tissue.scale?");
  EXPECT_EQ(refusal("time_step: 1"), "time_step: unknown key; did you mean solver.time_step?");
  EXPECT_EQ(refusal("tisue: {scale: 1}"), "tisue: unknown key; did you mean tissue?");
  EXPECT_EQ(refusal("nonsense: 1"), "nonsense: unknown key");
  EXPECT_EQ(refusal("tissue: {scale: 1, scale: 2}"), "tissue.scale: is given twice");
}

TEST(ConfigReader, WritesBadMappingsOnce) {
  EXPECT_EQ(refusal("tissue:\n  fixed:\n    - box:\n        min: [0, 0, 2]\n        max: [1, 1, 1]\n"),
            "tissue.fixed[0].box: {min: [0, 0, 2], max: [1, 1, 1]}: must be a box with min <= max");
}

TEST(ConfigReader, WritesBadListsInOneLine) {
  EXPECT_EQ(refusal("blade:\n  edge:\n    - [0, 0, 0]\n    -\n      - 0\n      - x\n"),
            "blade.edge: [[0, 0, 0], [0, x]]: must be a list of at least two points [x, y, z], no two in a "
            "row equal, or [] for none");
}

TEST(ConfigReader, WantsExactlyOneEdge) {
  EXPECT_NE(refusal("blade: {friction: 0.1}").find("exactly one"), std::string::npos);
  EXPECT_NE(refusal("blade: {edge: [[0, 0, 0], [1, 0, 0]], edge_links: [a, b]}").find("exactly one"),
            std::string::npos);
}

TEST(ConfigReader, AnEmptyListIsNoEdge) {
  EXPECT_NE(refusal("blade: {edge: [], edge_links: []}").find("neither is given"), std::string::npos);
  const auto config = read_config(YAML::Load("blade: {edge: [], edge_links: [heel, tip]}"));
  EXPECT_TRUE(config.simulation.blade.edge.empty());
  EXPECT_EQ(config.simulation.blade.edge_links, (std::vector<std::string>{"heel", "tip"}));
}

TEST(ConfigReader, ReadsNumbersInAnyForm) {
  const auto config = read_config(YAML::Load(kBlade + "solver: {tolerance: '1e-6', max_iterations: 5.0}\n"
                                                      "tissue: {voxel_size: [0.001, '2e-3', 1]}"));
  EXPECT_DOUBLE_EQ(config.simulation.dynamics.solver.tolerance, 1e-6);
  EXPECT_EQ(config.simulation.dynamics.solver.max_iterations, 5);
  EXPECT_EQ(config.simulation.tissue.voxel_size, Vec3(0.001, 0.002, 1.0));
}

TEST(ConfigReader, ReadsTheSampleConfigurationsWithOverrides) {
  const std::filesystem::path folder = std::filesystem::path(__FILE__).parent_path() / "../../config";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const Config config = read_config_file(
        entry.path(), {"tissue.materials.0.young_modulus=5000", "probes.0=[0, 0, 1]", "node.max_lag=1"});
    EXPECT_EQ(config.simulation.tissue.materials[0].young_modulus, 5000.0);
    EXPECT_EQ(config.simulation.probes.at(0), Vec3(0, 0, 1));
    EXPECT_EQ(config.node.max_lag, 1.0);
    ++files;
  }
  EXPECT_GE(files, 3);
}

TEST(ConfigReader, PlacesInListsAreOverriddenInBrackets) {
  const std::string path = testing::TempDir() + "materials.yaml";
  std::ofstream(path) << "tissue: {materials: [{label: 1}, {label: 2}]}\n";
  const auto materials =
      read_config_file(path, {"tissue.materials[1].density=900"}).simulation.tissue.materials;
  EXPECT_EQ(materials.at(1).density, 900.0);
  EXPECT_NE(materials.at(0).density, 900.0);
  EXPECT_THROW(read_config_file(path, {"tissue.materials[].density=900"}), ConfigError);
  EXPECT_THROW(read_config_file(path, {"[0].density=900"}), ConfigError);
}

TEST(ConfigReader, NamesFileAndLineOfASyntaxError) {
  const std::string path = testing::TempDir() + "bad_syntax.yaml";
  std::ofstream(path) << "tissue:\n  scale: [1\nblade: }\n";
  try {
    read_config_file(path, {});
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path + ":3: ", 0), 0u) << error.what();
  }
}

}  // namespace
}  // namespace cfem_cutting
