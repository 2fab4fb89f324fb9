#include "cfem_cutting/io/files.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {

std::string why_unreadable(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return std::make_error_code(std::errc::is_a_directory).message();
  errno = 0;
  if (std::ifstream(path)) return "";
  return std::generic_category().message(errno);
}

void check_readable(const std::string& path) {
  const std::string why = why_unreadable(path);
  if (!why.empty()) throw FileError(path + ": cannot be read: " + why);
}

}  // namespace cfem_cutting
