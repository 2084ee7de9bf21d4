#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vehd {

/// CRC-32 of bytes added in parts; the result does not depend on the division into parts. Every change confined to 32
/// consecutive bits is detected, any other with probability 1 − 2⁻³².
/// Source: the CRC-32 of zlib
class Checksum {
 public:
  Checksum() = default;
  /// Continues from the value of another checksum.
  explicit Checksum(std::int64_t value) : value_(static_cast<std::uint32_t>(value)) {}

  /// Appends bytes; numbers in the representation of this machine.
  void add(std::string_view bytes);
  void add(std::span<const double> values);
  void add(std::int64_t value);
  /// 0 ... 2³² − 1; 0 before the first byte.
  [[nodiscard]] std::int64_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

}  // namespace vehd
