#include "bie/sphere/legendre.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vehd {

LegendreRecurrence legendre_recurrence(int n, int m) {
  const double n2 = double(n) * n;
  const double m2 = double(m) * m;
  const double k2 = double(n - 1) * (n - 1);
  return {std::sqrt((4.0 * n2 - 1.0) / (n2 - m2)), std::sqrt((k2 - m2) / (4.0 * k2 - 1.0))};
}

double legendre_sectoral_factor(int m) {
  // The √2 that real harmonics with m > 0 carry enters once, at m = 1.
  return std::sqrt((2.0 * m + 1.0) / (2.0 * m)) * (m == 1 ? std::numbers::sqrt2 : 1.0);
}

namespace {

std::vector<Matrix> empty_tables(int order, int highest_m, Index n_theta) {
  std::vector<Matrix> tables(std::min(order, highest_m) + 1);
  for (int m = 0; m < static_cast<int>(tables.size()); ++m) tables[m] = Matrix::Zero(n_theta, order + 1 - m);
  return tables;
}

/// Column (n, m) of a table, times the factor that undoes the √2 jump between m = 0 and m > 0.
auto column(const std::vector<Matrix>& table, int n, int m, int seen_from_m) {
  const double factor = (m == 0 && seen_from_m > 0)   ? std::numbers::sqrt2
                        : (m > 0 && seen_from_m == 0) ? std::numbers::sqrt2 / 2
                                                      : 1.0;
  return factor * table[m].col(n - m);
}

/// d/dθ by the ladder in m at fixed n; with `source` = T gives dT/dθ, with `source` = dT/dθ the second derivative. The
/// source has one m more.
std::vector<Matrix> theta_derivative(int order, int highest_m, const std::vector<Matrix>& source) {
  std::vector<Matrix> result = empty_tables(order, highest_m, source[0].rows());
  for (int m = 0; m <= std::min(order, highest_m); ++m) {
    for (int n = m; n <= order; ++n) {
      auto out = result[m].col(n - m);
      const double nn = n;
      if (m == 0) {
        if (n > 0) out = -std::sqrt(nn * (nn + 1.0)) * column(source, n, 1, 0);
        continue;
      }
      out = 0.5 * std::sqrt((nn + m) * (nn - m + 1.0)) * column(source, n, m - 1, m);
      if (n > m) out -= 0.5 * std::sqrt((nn - m) * (nn + m + 1.0)) * column(source, n, m + 1, m);
    }
  }
  return result;
}

/// m T / sin θ by the ladder that lowers n; with `source` = dT/dθ gives its θ-derivative. The source has one m more.
std::vector<Matrix> m_over_sin(int order, int highest_m, const std::vector<Matrix>& source) {
  std::vector<Matrix> result = empty_tables(order, highest_m, source[0].rows());
  for (int m = 1; m <= std::min(order, highest_m); ++m) {
    for (int n = m; n <= order; ++n) {
      const double nn = n;
      const double scale = 0.5 * std::sqrt((2.0 * nn + 1.0) / (2.0 * nn - 1.0));
      auto out = result[m].col(n - m);
      out = scale * std::sqrt((nn + m) * (nn + m - 1.0)) * column(source, n - 1, m - 1, m);
      if (n - 1 >= m + 1) out += scale * std::sqrt((nn - m) * (nn - m - 1.0)) * column(source, n - 1, m + 1, m);
    }
  }
  return result;
}

}  // namespace

LegendreTables legendre_tables(int order, const Vector& theta) { return legendre_tables(order, theta, order); }

LegendreTables legendre_tables(int order, const Vector& theta, int highest_m) {
  LegendreTables tables;
  tables.value = empty_tables(order, highest_m + 2, theta.size());
  const Vector cos_theta = theta.array().cos();
  const Vector sin_theta = theta.array().sin();
  Vector sectoral = Vector::Constant(theta.size(), 1.0 / std::sqrt(4.0 * std::numbers::pi));
  for (int m = 0; m <= std::min(order, highest_m + 2); ++m) {
    if (m > 0) sectoral = legendre_sectoral_factor(m) * sin_theta.cwiseProduct(sectoral);
    Matrix& table = tables.value[m];
    table.col(0) = sectoral;
    for (int n = m + 1; n <= order; ++n) {
      const LegendreRecurrence r = legendre_recurrence(n, m);
      table.col(n - m) = r.a * cos_theta.cwiseProduct(table.col(n - m - 1));
      if (n > m + 1) table.col(n - m) -= r.a * r.b * table.col(n - m - 2);
    }
  }
  tables.d_theta = theta_derivative(order, highest_m + 1, tables.value);
  tables.m_over_sin = m_over_sin(order, highest_m, tables.value);
  tables.d2_theta = theta_derivative(order, highest_m, tables.d_theta);
  tables.d_m_over_sin = m_over_sin(order, highest_m, tables.d_theta);
  return tables;
}

}  // namespace vehd
