#include "cfem_cutting/io/config_reader.h"

#include "cfem_cutting/io/files.h"
#include "overrides.h"
#include "schema.h"

namespace cfem_cutting {
namespace {

YAML::Node load_yaml(const std::string& path) {
  check_readable(path);
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::Exception& error) {
    throw FileError(path + ":" + std::to_string(error.mark.line + 1) + ": not YAML: " + error.msg);
  }
}

/// What no single key can break.
void check_together(const YAML::Node& yaml, const SimulationConfig& config) {
  const FractureOptions& fracture = config.fracture;
  if (fracture.release_offset >= fracture.onset_offset)
    throw ConfigError("fracture.release_offset: " + format(fracture.release_offset) +
                      ": must be less than fracture.onset_offset, " + format(fracture.onset_offset));
  const BladeConfig& blade = config.blade;
  if (yaml["blade"] && blade.edge.empty() == blade.edge_links.empty())
    throw ConfigError(std::string("blade.edge, blade.edge_links: ") +
                      (blade.edge.empty() ? "neither is given" : "both are given") +
                      ": must be exactly one of them");
}

}  // namespace

Config read_config(const YAML::Node& yaml) {
  Config config;
  if (yaml.IsNull()) return config;
  if (!yaml.IsMap()) refuse({"configuration", yaml}, "a mapping of keys");
  read_mapping(config_fields(), yaml, "", config);
  check_together(yaml, config.simulation);
  return config;
}

Config read_config_file(const std::string& path, const std::vector<std::string>& overrides) {
  YAML::Node yaml = load_yaml(path);
  for (const std::string& override_text : overrides) apply_override(yaml, override_text);
  return read_config(yaml);
}

}  // namespace cfem_cutting
