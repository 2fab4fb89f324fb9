#pragma once
/// Checks that also write down what was expected and what came out, for doc/verification.md.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace cfem_cutting {

/// The lines of one case. scripts/verification_table.py reads the files that the tests leave in
/// CFEM_CUTTING_VERIFICATION_DIR, one a test: fields separated by tabs.
class Record {
 public:
  /// @param section heading of the table
  /// @param source where the expected values come from
  Record(std::string section, std::string source);

  /// Expects |obtained − expected| ≤ tolerance · |expected|.
  void relative(const std::string& name, double expected, double obtained, double tolerance);

  /// Expects |obtained − expected| ≤ tolerance.
  void absolute(const std::string& name, double expected, double obtained, double tolerance);

  /// Expects |obtained| ≤ bound.
  void at_most(const std::string& name, double bound, double obtained);

  /// Expects `passed`; `rule` says in words what was asked.
  void judged(const std::string& name, double expected, double obtained, const std::string& rule,
              bool passed);

  /// Notes a value that nothing is asked of.
  void note(const std::string& name, double obtained);

  /// A point of a curve in one of the pictures.
  void point(const std::string& picture, const std::string& curve, double x, double y);

 private:
  void line(const std::string& name, const std::string& expected, double obtained, const std::string& rule,
            bool passed);

  std::string section_, source_;
  std::ofstream file_;
};

}  // namespace cfem_cutting
