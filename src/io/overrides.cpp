#include "overrides.h"

#include <algorithm>
#include <regex>
#include <vector>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

bool is_place(const std::string& part) {
  return !part.empty() && part.size() < 7 &&
         std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// Places in lists may be written as in error messages: `list[0].key` for `list.0.key`.
std::vector<std::string> split(const std::string& path) {
  static const std::regex place(R"(\[(\d+)\])");
  std::vector<std::string> parts{""};
  for (char c : std::regex_replace(path, place, ".$1"))
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The node with one entry set, recursively; yaml-cpp's nodes are handles, so what is below is built first.
YAML::Node with_entry(YAML::Node node, const std::vector<std::string>& parts, std::size_t depth,
                      const YAML::Node& value, const std::string& text) {
  if (depth == parts.size()) return value;
  const std::string& part = parts[depth];
  const bool is_list = node.IsSequence() || ((!node.IsDefined() || node.IsNull()) && is_place(part));
  if (is_list) {
    if (!is_place(part))
      throw ConfigError("--set " + text + ": '" + part + "' must be a place in a list, from 0");
    const std::size_t place = std::stoul(part), size = node.IsSequence() ? node.size() : 0;
    if (place > size)
      throw ConfigError("--set " + text + ": place " + part + " of a list of " + std::to_string(size));
    const YAML::Node below = place < size ? node[place] : YAML::Node();
    const YAML::Node entry = with_entry(below, parts, depth + 1, value, text);
    if (place < size)
      node[place] = entry;
    else
      node.push_back(entry);
    return node;
  }
  if (node.IsDefined() && !node.IsNull() && !node.IsMap())
    throw ConfigError("--set " + text + ": there are no keys below a value, such as '" + part + "'");
  YAML::Node below = node.IsMap() && node[part] ? node[part] : YAML::Node();
  node[part] = with_entry(below, parts, depth + 1, value, text);
  return node;
}

}  // namespace

void apply_override(YAML::Node& yaml, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::vector<std::string> parts = split(text.substr(0, equals));
  if (equals == std::string::npos || std::count(parts.begin(), parts.end(), "") > 0)
    throw ConfigError("--set " + text + ": must be key.path=value");
  YAML::Node value;
  try {
    value = YAML::Load(text.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw ConfigError("--set " + text + ": the value is not YAML: " + error.msg);
  }
  yaml = with_entry(yaml, parts, 0, value, text);
}

}  // namespace cfem_cutting
