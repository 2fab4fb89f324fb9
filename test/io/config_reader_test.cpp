#include "cfem_cutting/io/config_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

const std::string kBlade = "blade: {edge: [[0, 0, 0], [0.03, 0, 0]]}\n";

std::string refusal(const std::string& yaml) try {
  read_config(YAML::Load(yaml));
  return "";
} catch (const ConfigError& error) {
  return error.what();
}

struct Rejection {
  std::string schema_key;
  std::string yaml;
  std::string message;  ///< how it starts
};

const std::vector<Rejection> kRejections{
    {"tissue.frame", "tissue: {frame: ''}", "tissue.frame: "},
    {"tissue.source", "tissue: {source: 5}", "tissue.source: 5: must be a text"},
    {"tissue.box_size", "tissue: {box_size: [0.1, 0, 0.1]}", "tissue.box_size: "},
    {"tissue.scale", "tissue: {scale: 0}", "tissue.scale: 0: must be a number > 0"},
    {"tissue.xyz", "tissue: {xyz: [0, 0]}", "tissue.xyz: "},
    {"tissue.rpy", "tissue: {rpy: [0, 0, a]}", "tissue.rpy: "},
    {"tissue.labels", "tissue: {labels: [256]}", "tissue.labels: "},
    {"tissue.voxel_size", "tissue: {voxel_size: [0.1, 0.1]}", "tissue.voxel_size: "},
    {"tissue.composite_level", "tissue: {composite_level: 5}", "tissue.composite_level: 5: "},
    {"tissue.gravity", "tissue: {gravity: 9.81}", "tissue.gravity: "},
    {"tissue.materials", "tissue: {materials: []}", "tissue.materials: "},
    {"tissue.materials[].label", "tissue: {materials: [{label: 1.5}]}", "tissue.materials[0].label: "},
    {"tissue.materials[].young_modulus", "tissue: {materials: [{young_modulus: -1}]}",
     "tissue.materials[0].young_modulus: -1"},
    {"tissue.materials[].poisson_ratio", "tissue: {materials: [{}, {poisson_ratio: 0.5}]}",
     "tissue.materials[1].poisson_ratio: 0.5: must be a number in [0, 0.5)"},
    {"tissue.materials[].density", "tissue: {materials: [{density: .nan}]}", "tissue.materials[0].density: "},
    {"tissue.materials[].toughness", "tissue: {materials: [{toughness: 0}]}",
     "tissue.materials[0].toughness: "},
    {"tissue.materials[].tensile_strength", "tissue: {materials: [{tensile_strength: x}]}",
     "tissue.materials[0].tensile_strength: "},
    {"tissue.fixed", "tissue: {fixed: {}}", "tissue.fixed: "},
    {"tissue.fixed[].box.min", "tissue: {fixed: [{box: {max: [1, 1, 1]}}]}", "tissue.fixed[0].box: "},
    {"tissue.fixed[].box.max", "tissue: {fixed: [{box: {min: [0, 0, 2], max: [1, 1, 1]}}]}",
     "tissue.fixed[0].box: "},
    {"tissue.fixed[].displacement", "tissue: {fixed: [{displacement: 1}]}", "tissue.fixed[0].displacement: "},
    {"tissue.fixed[].ramp", "tissue: {fixed: [{ramp: 0}]}", "tissue.fixed[0].ramp: 0: "},
    {"tissue.fixed[].follow", "tissue: {fixed: [{follow: []}]}", "tissue.fixed[0].follow: "},
    {"blade.edge", "blade: {edge: [[0, 0, 0]]}", "blade.edge: "},
    {"blade.edge_links", "blade: {edge_links: [heel]}", "blade.edge_links: "},
    {"blade.urdf", "blade: {urdf: 1}", "blade.urdf: "},
    {"blade.back", "blade: {back: [0, 0, 0]}", "blade.back: "},
    {"blade.friction", "blade: {friction: -0.1}", "blade.friction: "},
    {"blade.tool_link", "blade: {tool_link: ''}", "blade.tool_link: "},
    {"blade.max_travel", "blade: {max_travel: 0}", "blade.max_travel: "},
    {"fracture.mode", "fracture: {mode: slow}", "fracture.mode: slow: must be delayed or immediate"},
    {"fracture.criterion", "fracture: {criterion: energy}",
     "fracture.criterion: energy: only offset is implemented"},
    {"fracture.onset_offset", "fracture: {onset_offset: 0}", "fracture.onset_offset: "},
    {"fracture.release_offset", "fracture: {release_offset: 0.003}",
     "fracture.release_offset: 0.003: must be less"},
    {"surface.influence_domain_adaptation", "surface: {influence_domain_adaptation: 2}",
     "surface.influence_domain_adaptation: 2: must be true or false"},
    {"solver.element", "solver: {element: tet}", "solver.element: "},
    {"solver.kinematics", "solver: {kinematics: x}", "solver.kinematics: "},
    {"solver.integration", "solver: {integration: true}", "solver.integration: "},
    {"solver.time_step", "solver: {time_step: 0.2}", "solver.time_step: 0.2: must be a number in (0, 0.1]"},
    {"solver.tolerance", "solver: {tolerance: 1e-13}", "solver.tolerance: "},
    {"solver.max_iterations", "solver: {max_iterations: 0}", "solver.max_iterations: "},
    {"solver.rayleigh_mass", "solver: {rayleigh_mass: -1}", "solver.rayleigh_mass: "},
    {"solver.rayleigh_stiffness", "solver: {rayleigh_stiffness: -1}", "solver.rayleigh_stiffness: "},
    {"solver.threads", "solver: {threads: -1}", "solver.threads: "},
    {"probes", "probes: [0, 0, 0]", "probes: "},
    {"node.pose_input", "node: {pose_input: joy}", "node.pose_input: "},
    {"node.tool_frame", "node: {tool_frame: ''}", "node.tool_frame: "},
    {"node.timing", "node: {timing: fast}", "node.timing: "},
    {"node.max_lag", "node: {max_lag: 0}", "node.max_lag: "},
    {"node.input_timeout", "node: {input_timeout: 0}", "node.input_timeout: "},
    {"node.marker_rate", "node: {marker_rate: 0}", "node.marker_rate: "},
    {"node.output_dir", "node: {output_dir: ''}", "node.output_dir: "},
    {"node.reset_on_loop", "node: {reset_on_loop: maybe}", "node.reset_on_loop: "},
};

TEST(ConfigReader, RefusesBadValuesByKeyAndRule) {
  for (const Rejection& rejection : kRejections)
    EXPECT_EQ(refusal(rejection.yaml).rfind(rejection.message, 0), 0u)
        << rejection.yaml << " → '" << refusal(rejection.yaml) << "'";
}

TEST(ConfigReader, EveryKeyHasARejectionTest) {
  std::set<std::string> tested;
  for (const Rejection& rejection : kRejections) tested.insert(rejection.schema_key);
  for (const KeyDoc& key : schema()) EXPECT_EQ(tested.count(key.key), 1u) << key.key;
}

TEST(ConfigReader, NamesUnknownKeysAndTheNearestKnownOne) {
  EXPECT_EQ(refusal("tissue: {scal: 1}"), "tissue.scal: unknown key; did you mean tissue.scale?");
  EXPECT_EQ(refusal("time_step: 1"), "time_step: unknown key; did you mean solver.time_step?");
  EXPECT_EQ(refusal("nonsense: 1"), "nonsense: unknown key");
  EXPECT_EQ(refusal("tissue: {scale: 1, scale: 2}"), "tissue.scale: is given twice");
}

TEST(ConfigReader, WantsExactlyOneEdge) {
  EXPECT_NE(refusal("blade: {friction: 0.1}").find("exactly one"), std::string::npos);
  EXPECT_NE(refusal("blade: {edge: [[0, 0, 0], [1, 0, 0]], edge_links: [a, b]}").find("exactly one"),
            std::string::npos);
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
