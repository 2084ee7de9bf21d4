#pragma once

#include <stdexcept>
#include <string>

namespace vehd {

/// Unusable input: scene, command line or input file. Exit code 1. The message is one line: control characters become
/// blanks.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string message);
};

/// Sizes of arguments do not match: an error of the caller, never of the user.
class ShapeError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// A linear or nonlinear solve ended without reaching its tolerance.
class ConvergenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A text shortened for a message: cut after 60 bytes and followed by " ..." if it is longer.
std::string shortened(const std::string& text);

/// Throws ShapeError "WHAT has ACTUAL entries but EXPECTED are expected" unless both agree.
void require_size(const char* what, long actual, long expected);

}  // namespace vehd
