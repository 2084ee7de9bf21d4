#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace vehd {

/// Bytes as text of letters, digits, + and /, padded with = (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace vehd
