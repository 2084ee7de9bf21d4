#include "bie/support/errors.hpp"

#include <fmt/format.h>

namespace vehd {

void require_size(const char* what, long actual, long expected) {
  if (actual != expected) {
    throw ShapeError(fmt::format("{} has {} entries but {} are expected", what, actual, expected));
  }
}

}  // namespace vehd
