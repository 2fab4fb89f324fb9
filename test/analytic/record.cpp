#include "record.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace cfem_cutting {
namespace {

std::string text(double value, int digits = 6) {
  std::ostringstream stream;
  stream.precision(digits);
  stream << value;
  return stream.str();
}

std::string percent(double part) { return "± " + text(100.0 * part, 3) + " %"; }

/// One file a test, which its first record empties: tests run as processes of their own, several at a time.
std::ofstream open_file_of_this_test() {
  static std::string previous;
  const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "." + info->name();
  std::replace(name.begin(), name.end(), '/', '-');
  std::filesystem::create_directories(CFEM_CUTTING_VERIFICATION_DIR);
  const auto mode = name == previous ? std::ios::app : std::ios::trunc;
  previous = name;
  return std::ofstream(std::string(CFEM_CUTTING_VERIFICATION_DIR) + "/" + name + ".tsv", mode);
}

}  // namespace

Record::Record(std::string section, std::string source)
    : section_(std::move(section)), source_(std::move(source)), file_(open_file_of_this_test()) {}

void Record::relative(const std::string& name, double expected, double obtained, double tolerance) {
  judged(name, expected, obtained, percent(tolerance),
         std::abs(obtained - expected) <= tolerance * std::abs(expected));
}

void Record::absolute(const std::string& name, double expected, double obtained, double tolerance) {
  judged(name, expected, obtained, "± " + text(tolerance, 3), std::abs(obtained - expected) <= tolerance);
}

void Record::at_most(const std::string& name, double bound, double obtained) {
  line(name, "0", obtained, "≤ " + text(bound, 3), std::abs(obtained) <= bound);
}

void Record::judged(const std::string& name, double expected, double obtained, const std::string& rule,
                    bool passed) {
  line(name, text(expected), obtained, rule, passed);
}

void Record::note(const std::string& name, double obtained) { line(name, "", obtained, "", true); }

void Record::point(const std::string& picture, const std::string& curve, double x, double y) {
  file_ << "point\t" << picture << '\t' << curve << '\t' << text(x) << '\t' << text(y) << '\n';
}

void Record::line(const std::string& name, const std::string& expected, double obtained,
                  const std::string& rule, bool passed) {
  EXPECT_TRUE(passed) << section_ << ", " << name << ": expected " << expected << ' ' << rule << ", obtained "
                      << text(obtained);
  file_ << "case\t" << section_ << '\t' << name << '\t' << source_ << '\t' << expected << '\t'
        << text(obtained) << '\t' << rule << '\t' << (passed ? "yes" : "no") << '\n';
}

}  // namespace cfem_cutting
