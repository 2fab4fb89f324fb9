#pragma once
/// Errors caused by input. Every message is one line that names the key, file or topic, the value and
/// the rule; command line programs print it and exit with 2.

#include <stdexcept>

namespace cfem_cutting {

/// Base of all errors that a user can mend.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A parameter is unknown, of the wrong type or out of range.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A file is missing, unreadable or not what it claims to be.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A shape can't be used: an open mesh, an empty volume, too many voxels.
class GeometryError : public Error {
 public:
  using Error::Error;
};

}  // namespace cfem_cutting
