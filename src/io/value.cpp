#include "value.h"

#include <cmath>
#include <limits>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/io/number.h"

namespace cfem_cutting {
namespace {

constexpr std::size_t kLongestValueShown = 80;

/// Has a node and all below it written in one line.
void set_flow(YAML::Node node) {
  node.SetStyle(YAML::EmitterStyle::Flow);
  if (node.IsSequence())
    for (const YAML::Node& item : node) set_flow(item);
  if (node.IsMap())
    for (const auto& entry : node) set_flow(entry.second);
}

std::string shown(const YAML::Node& node) {
  if (!node.IsDefined()) return "nothing";
  const YAML::Node copy = YAML::Clone(node);
  set_flow(copy);
  YAML::Emitter emitter;
  emitter << copy;
  std::string text = emitter.c_str();
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text.size() > kLongestValueShown ? text.substr(0, kLongestValueShown) + "…" : text;
}

bool is_quoted(const YAML::Node& node) { return node.Tag() == "!"; }

}  // namespace

void refuse(const Value& value, const std::string& rule) {
  throw ConfigError(value.key + ": " + shown(value.node) + ": must be " + rule);
}

bool parse(const YAML::Node& node, double& number) {
  return node.IsScalar() && parse_number(node.Scalar(), number);
}

bool parse(const YAML::Node& node, int& number) {
  double real;
  if (!parse(node, real) || std::floor(real) != real) return false;
  if (std::abs(real) > std::numeric_limits<int>::max()) return false;
  number = static_cast<int>(real);
  return true;
}

bool parse(const YAML::Node& node, bool& flag) {
  return node.IsScalar() && YAML::convert<bool>::decode(node, flag);
}

bool parse(const YAML::Node& node, std::string& text) {
  double number;
  bool flag;
  if (!node.IsScalar()) return false;
  if (!is_quoted(node) && (parse(node, number) || parse(node, flag))) return false;
  text = node.Scalar();
  return true;
}

bool parse(const YAML::Node& node, Vec3& vector) {
  std::vector<double> numbers;
  if (!parse(node, numbers) || numbers.size() != 3) return false;
  vector = Vec3(numbers[0], numbers[1], numbers[2]);
  return true;
}

std::string format(double number) { return format_number(number); }
std::string format(int number) { return std::to_string(number); }
std::string format(bool flag) { return flag ? "true" : "false"; }
std::string format(const std::string& text) { return text.empty() ? "''" : text; }
std::string format(const Vec3& vector) {
  return format(std::vector<double>(vector.data(), vector.data() + vector.size()));
}

}  // namespace cfem_cutting
