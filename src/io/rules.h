#pragma once
/// The rules of the schema, each with its words.

#include <algorithm>

#include "value.h"

namespace cfem_cutting {

inline Rule<double> any_number() {
  return {"a number", [](double) { return true; }};
}
inline Rule<double> positive() {
  return {"a number > 0", [](double x) { return x > 0; }};
}
inline Rule<double> not_negative() {
  return {"a number >= 0", [](double x) { return x >= 0; }};
}
inline Rule<double> between(double low, double high) {
  return {"a number in [" + format(low) + ", " + format(high) + "]",
          [=](double x) { return low <= x && x <= high; }};
}
inline Rule<double> below(double low, double high) {
  return {"a number in [" + format(low) + ", " + format(high) + ")",
          [=](double x) { return low <= x && x < high; }};
}
inline Rule<double> up_to(double high) {
  return {"a number in (0, " + format(high) + "]", [=](double x) { return 0 < x && x <= high; }};
}
inline Rule<int> integer(int low, int high) {
  return {"an integer from " + format(low) + " to " + format(high),
          [=](int n) { return low <= n && n <= high; }};
}
inline Rule<bool> true_or_false() {
  return {"true or false", [](bool) { return true; }};
}
inline Rule<std::string> text() {
  return {"a text", [](const std::string&) { return true; }};
}
inline Rule<std::string> filled_text() {
  return {"a text, not empty", [](const std::string& s) { return !s.empty(); }};
}
inline Rule<std::vector<int>> labels() {
  return {"a list of integers from 0 to 255", [](const std::vector<int>& labels) {
            return std::all_of(labels.begin(), labels.end(), [](int n) { return 0 <= n && n <= 255; });
          }};
}
inline Rule<std::vector<int>> some_labels() {
  return {labels().text + ", not empty",
          [](const std::vector<int>& list) { return !list.empty() && labels().holds(list); }};
}
inline Rule<Vec3> vector() {
  return {"three numbers", [](const Vec3&) { return true; }};
}
inline Rule<Vec3> positive_vector() {
  return {"three numbers > 0", [](const Vec3& v) { return (v.array() > 0).all(); }};
}
inline Rule<Vec3> colour() {
  return {"three numbers from 0 to 1",
          [](const Vec3& v) { return (v.array() >= 0).all() && (v.array() <= 1).all(); }};
}
inline Rule<Vec3> direction() {
  return {"three numbers, not all zero", [](const Vec3& v) { return !v.isZero(0.0); }};
}

}  // namespace cfem_cutting
