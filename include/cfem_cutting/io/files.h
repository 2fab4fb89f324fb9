#pragma once

#include <string>

namespace cfem_cutting {

/// The system's words for why a file cannot be read, such as "No such file or directory"; empty if it can.
std::string why_unreadable(const std::string& path);

/// @throw FileError names the file and why it cannot be read
void check_readable(const std::string& path);

}  // namespace cfem_cutting
