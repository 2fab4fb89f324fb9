#pragma once
/// Reading single YAML values: strict in type, lenient in how a number is written.

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// A value and the key it stands under.
struct Value {
  std::string key;
  YAML::Node node;
};

/// What a value has to be: words that complete "must be …", and the test.
template <typename T>
struct Rule {
  std::string text;
  std::function<bool(const T&)> holds;
};

/// @throw ConfigError always: key, value, rule
[[noreturn]] void refuse(const Value& value, const std::string& rule);

/// Each reads a value of its type. Numbers may be integers, reals or numeric strings, and are finite.
/// @return false if the value is of another type
bool parse(const YAML::Node& node, double& number);
bool parse(const YAML::Node& node, int& number);
bool parse(const YAML::Node& node, bool& flag);
bool parse(const YAML::Node& node, std::string& text);
bool parse(const YAML::Node& node, Vec3& vector);

template <typename T>
bool parse(const YAML::Node& node, std::vector<T>& list) {
  if (!node.IsSequence()) return false;
  list.clear();
  for (const YAML::Node& item : node) {
    T element;
    if (!parse(item, element)) return false;
    list.push_back(std::move(element));
  }
  return true;
}

/// How a value is written in YAML, on one line.
std::string format(double number);
std::string format(int number);
std::string format(bool flag);
std::string format(const std::string& text);
std::string format(const Vec3& vector);

template <typename T>
std::string format(const std::vector<T>& list) {
  std::string text;
  for (const T& element : list) text += (text.empty() ? "" : ", ") + format(element);
  return "[" + text + "]";
}

}  // namespace cfem_cutting
