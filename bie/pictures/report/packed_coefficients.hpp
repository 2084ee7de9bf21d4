#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Harmonic coefficients of one field at many times, as the page reads them: 16-bit integers, little endian, in units
/// of 1/32767 of the largest coefficient of the component and time. The position of a vesicle of degree 16 takes 1.7 kB
/// per time, whereas a surface fine enough for display would take 50.
class PackedCoefficients {
 public:
  /// Appends the coefficients of one time.
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

/// The value to six significant digits, enough for a picture; JSON null if it is not finite.
nlohmann::json rounded_for_page(double value);
nlohmann::json rounded_for_page(const std::vector<double>& values);

/// Bytes as text of letters, digits, + and /, padded with = (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace vehd
