#include "bie/fit/free_key.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vehd {

double FreeKey::coordinate_of(double number) const { return is_logarithmic ? std::log(number) : number / (to - from); }

double FreeKey::number_of(double coordinate) const {
  return is_logarithmic ? std::exp(coordinate) : coordinate * (to - from);
}

std::string FreeKey::setting_of(double number) const {
  return unit.empty() ? fmt::format("{}={}", name, number) : fmt::format("{}=\"{} {}\"", name, number, unit);
}

double FreeKey::error_of(double number, double error_of_coordinate) const {
  return error_of_coordinate * (is_logarithmic ? number : to - from);
}

}  // namespace vehd
