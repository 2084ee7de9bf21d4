#include <cstring>

#include "bie/support/processor/features.hpp"

namespace vehd::processor {

std::size_t find_missing(const char* const* needed, const char* const* present, const char** missing) {
  std::size_t count = 0;
  for (; *needed != nullptr; ++needed) {
    const char* const* found = present;
    while (*found != nullptr && std::strcmp(*found, *needed) != 0) ++found;
    if (*found == nullptr) missing[count++] = *needed;
  }
  missing[count] = nullptr;
  return count;
}

}  // namespace vehd::processor
