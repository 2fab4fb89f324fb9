#pragma once

#include <string>

namespace cfem_cutting {

/// Shortest text that reads back as the same number; the same in every locale and on every run.
std::string format_number(double number);

/// Reads a text that is one finite number and nothing else.
/// @return whether it is
bool parse_number(const std::string& text, double& number);

}  // namespace cfem_cutting
