#include "bie/stepping/time/time_rule.hpp"

#include <cmath>

namespace vehd {

TimeRule time_rule(int order) {
  if (order == 1) return {{1.0}, Matrix::Zero(1, 2), {1.0}};
  if (order == 2) return {{1.0}, Matrix{{0.5, 0.5}}, {1.0}};
  const double s = std::sqrt(6.0);
  if (order == 3) {
    // D from the trace and the determinant of I − D⁻¹Q, both 0 after subtracting the eigenvalue.
    const double d1 = 10.0 / (24.0 + 6.0 * s);
    return {{1.0 / 3.0, 1.0},
            Matrix{{0.0, 5.0 / 12.0, -1.0 / 12.0}, {0.0, 3.0 / 4.0, 1.0 / 4.0}},
            {d1, 1.0 / (8.0 - 5.0 / (3.0 * d1))}};
  }
  return {{0.4 - 0.1 * s, 0.4 + 0.1 * s, 1.0},
          Matrix{{0.0, (88.0 - 7.0 * s) / 360.0, (296.0 - 169.0 * s) / 1800.0, (3.0 * s - 2.0) / 225.0},
                 {0.0, (296.0 + 169.0 * s) / 1800.0, (88.0 + 7.0 * s) / 360.0, -(3.0 * s + 2.0) / 225.0},
                 {0.0, (16.0 - s) / 36.0, (16.0 + s) / 36.0, 1.0 / 9.0}},
          {0.10404994025001671, 0.33281274542850664, 0.4812901402100925}};
}

Vector integration_weights(const TimeRule& rule, double c) {
  // Those that are exact for every power.
  const Index n = static_cast<Index>(rule.nodes.size()) + 1;
  Matrix powers(n, n);
  Vector integrals(n);
  for (Index k = 0; k < n; ++k) {
    const double degree = static_cast<double>(k);
    integrals[k] = std::pow(c, degree + 1.0) / (degree + 1.0);
    powers(k, 0) = k == 0 ? 1.0 : 0.0;
    for (Index j = 1; j < n; ++j) powers(k, j) = std::pow(rule.nodes[static_cast<std::size_t>(j - 1)], degree);
  }
  return powers.partialPivLu().solve(integrals);
}

}  // namespace vehd
