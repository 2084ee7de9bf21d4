#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Harmonic coefficients of one field at many times, as the page reads them: every number is a 16-bit integer, little
/// endian, in parts of 32767 of the largest coefficient of its component and time. A vesicle of degree 16 so takes 1.7
/// kB a time for its position, where a surface fit to look at would take 50.
class PackedCoefficients {
 public:
  /// Appends a time.
  /// @param coefficients  [n_coefficients x components]
  void add(const Matrix& coefficients);
  /// {"scale": [times][components], "data": base64 of times, components, coefficients}
  [[nodiscard]] nlohmann::json json() const;

 private:
  std::vector<std::vector<double>> scales_;
  std::vector<std::uint8_t> bytes_;
};

/// Bytes that coefficients of this degree take in a page, per component and time.
std::size_t packed_bytes(int order);

/// The value to six significant digits: enough for a picture. JSON null if it is no number.
nlohmann::json rounded_for_page(double value);
nlohmann::json rounded_for_page(const std::vector<double>& values);

/// Bytes as text of letters, digits, + and /, padded with = (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace vehd
