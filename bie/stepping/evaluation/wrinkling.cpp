#include "bie/stepping/evaluation/wrinkling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vehd {

double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius) {
  if (!(least_tension < 0.0)) return 0.0;
  if (!parameters.bending) return std::numeric_limits<double>::infinity();
  return radius * std::sqrt(-2.0 * least_tension / (3.0 * parameters.bending->modulus));
}

double disturbance_rate(const FlowParameters& parameters, double tension, double radius, int degree) {
  const double rigidity = parameters.bending ? 0.5 * parameters.bending->modulus : 0.0;
  const double n = degree, product = n * (n + 1.0);
  const double driving = -rigidity * product / (radius * radius) - tension;
  const double cubic = (2.0 * n + 3.0) * n * n;
  const double friction = (cubic - 5.0) * parameters.viscosity_ratio + cubic + 4.0;
  return (n - 1.0) * product * (n + 2.0) * driving / (parameters.viscosity * radius * friction);
}

double wrinkling_rate(const FlowParameters& parameters, double tension, double radius, int highest_degree) {
  double fastest = 0.0;
  for (int degree = 2; degree <= highest_degree; ++degree) {
    fastest = std::max(fastest, disturbance_rate(parameters, tension, radius, degree));
  }
  return fastest;
}

}  // namespace vehd
