#pragma once

#include <ostream>
#include <string>
#include <type_traits>

#include "cfem_cutting/geometry/types.h"
#include "cfem_cutting/io/number.h"

namespace cfem_cutting {

/// One line of a CSV file, ended when it goes out of scope.
class CsvRow {
 public:
  explicit CsvRow(std::ostream& stream) : stream_(stream) {}
  ~CsvRow() { stream_ << '\n'; }
  CsvRow(const CsvRow&) = delete;
  CsvRow& operator=(const CsvRow&) = delete;

  CsvRow& operator<<(const std::string& cell) {
    if (!first_) stream_ << ',';
    first_ = false;
    stream_ << cell;
    return *this;
  }
  CsvRow& operator<<(double number) { return *this << format_number(number); }
  template <typename Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  CsvRow& operator<<(Integer number) {
    return *this << std::to_string(number);
  }
  CsvRow& operator<<(const Vec3& v) { return *this << v.x() << v.y() << v.z(); }

 private:
  std::ostream& stream_;
  bool first_ = true;
};

}  // namespace cfem_cutting
