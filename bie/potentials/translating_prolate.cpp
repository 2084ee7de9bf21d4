#include "bie/potentials/translating_prolate.hpp"

#include <cmath>

namespace vehd {

ProlateSpeeds translating_prolate_speeds() {
  const double e = std::sqrt(0.75);
  const double logarithm = std::log((1.0 + e) / (1.0 - e));
  const double along = 8.0 / 3.0 * e * e * e / (-2.0 * e + (1.0 + e * e) * logarithm);
  const double across = 16.0 / 3.0 * e * e * e / (2.0 * e + (3.0 * e * e - 1.0) * logarithm);
  return {2.0 / (3.0 * along), 2.0 / (3.0 * across)};
}

}  // namespace vehd
