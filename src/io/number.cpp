#include "cfem_cutting/io/number.h"

#include <cmath>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>

namespace cfem_cutting {

std::string format_number(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  if (number == 0.0) return "0";  // no minus
  std::string text = nlohmann::json(number).dump();
  const std::size_t end = text.size();
  return end > 2 && text.compare(end - 2, 2, ".0") == 0 ? text.substr(0, end - 2) : text;
}

bool parse_number(const std::string& text, double& number) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  if (!(stream >> number)) return false;
  return (stream >> std::ws).eof() && std::isfinite(number);
}

}  // namespace cfem_cutting
