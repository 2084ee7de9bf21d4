#pragma once

#include <stdexcept>

namespace vehd {

/// A file could not be written: no permission, disk full, directory gone. Exit code 1.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vehd
