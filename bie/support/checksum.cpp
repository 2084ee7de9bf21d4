#include "bie/support/checksum.hpp"

#include <zlib.h>

namespace vehd {

void Checksum::add(std::string_view bytes) {
  value_ =
      static_cast<std::uint32_t>(crc32_z(value_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void Checksum::add(std::span<const double> values) {
  add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
}

void Checksum::add(std::int64_t value) { add(std::string_view(reinterpret_cast<const char*>(&value), sizeof value)); }

}  // namespace vehd
