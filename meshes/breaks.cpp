#include "meshes/breaks.hpp"

namespace vehd::meshes {

std::vector<double> even_breaks(int n) {
  std::vector<double> result;
  for (int k = 0; k <= n; ++k) result.push_back(2.0 * k / n - 1.0);
  return result;
}

std::vector<double> layer_breaks(int layers, double growth) {
  std::vector<double> result{0.0};
  double thickness = 1.0;
  for (int k = 0; k < layers; ++k, thickness *= growth) result.push_back(result.back() + thickness);
  for (double& value : result) value /= result.back();
  return result;
}

}  // namespace vehd::meshes
