#include "bie/stepping/evaluation/wrinkling.hpp"

#include <cmath>
#include <limits>

namespace vehd {

double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius) {
  if (!(least_tension < 0.0)) return 0.0;
  if (!parameters.bending) return std::numeric_limits<double>::infinity();
  return radius * std::sqrt(-2.0 * least_tension / (3.0 * parameters.bending->modulus));
}

}  // namespace vehd
