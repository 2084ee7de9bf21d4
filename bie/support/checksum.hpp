#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vehd {

/// CRC-32 of bytes given in parts: the same however they are divided. Every change of one bit and of bits within 32
/// neighbouring ones is noticed, any other with probability 1 − 2⁻³².
/// Source: the CRC-32 of zlib
class Checksum {
 public:
  Checksum() = default;
  /// Continues from the value that another one had reached.
  explicit Checksum(std::int64_t value) : value_(static_cast<std::uint32_t>(value)) {}

  /// Adds bytes behind those so far; numbers as this machine stores them.
  void add(std::string_view bytes);
  void add(std::span<const double> values);
  void add(std::int64_t value);
  /// 0 ... 2³² − 1; 0 before the first byte.
  [[nodiscard]] std::int64_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

}  // namespace vehd
