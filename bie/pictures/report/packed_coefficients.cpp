#include "bie/pictures/report/packed_coefficients.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

constexpr double largest_integer = 32767.0;

}  // namespace

void PackedCoefficients::add(const Matrix& coefficients) {
  std::vector<double> scales;
  for (Index component = 0; component < coefficients.cols(); ++component) {
    const double scale = coefficients.col(component).cwiseAbs().maxCoeff();
    scales.push_back(scale);
    for (const double value : coefficients.col(component)) {
      const double share = scale > 0.0 ? value / scale : 0.0;
      const auto integer = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(share * largest_integer)));
      bytes_.push_back(static_cast<std::uint8_t>(integer & 0xffU));
      bytes_.push_back(static_cast<std::uint8_t>(integer >> 8U));
    }
  }
  scales_.push_back(std::move(scales));
}

nlohmann::json PackedCoefficients::json() const {
  nlohmann::json scales = nlohmann::json::array();
  for (const std::vector<double>& of_time : scales_) scales.push_back(rounded_for_page(of_time));
  return {{"scale", std::move(scales)}, {"data", base64(bytes_)}};
}

std::size_t packed_bytes(int order) { return static_cast<std::size_t>(n_coefficients(order)) * 2 * 4 / 3; }

nlohmann::json rounded_for_page(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

nlohmann::json rounded_for_page(const std::vector<double>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) list.push_back(rounded_for_page(value));
  return list;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = (group << 8U) | (i + j < bytes.size() ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j <= bytes.size() ? letters[(group >> (18U - 6U * j)) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace vehd
