#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace cfem_cutting {

/// Sets `key.path=value` in a document; makes mappings on the way, and takes numbers as places in lists (the
/// place after the last one appends).
/// @param text value is YAML
/// @throw ConfigError not of this form, or no such place
void apply_override(YAML::Node& yaml, const std::string& text);

}  // namespace cfem_cutting
