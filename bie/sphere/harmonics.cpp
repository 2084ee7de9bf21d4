#include "bie/sphere/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bie/sphere/legendre.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

int degree_of(Index index) { return static_cast<int>(std::sqrt(static_cast<double>(index))); }

int order_of(Index count) {
  const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count)))) - 1;
  if (order < 0 || n_coefficients(order) != count) {
    throw ShapeError("a coefficient array has " + std::to_string(count) + " rows, which is not (p + 1)^2");
  }
  return order;
}

Matrix resize_order(const Matrix& coefficients, int order) {
  Matrix result = Matrix::Zero(n_coefficients(order), coefficients.cols());
  const Index common = std::min(result.rows(), coefficients.rows());
  result.topRows(common) = coefficients.topRows(common);
  return result;
}

namespace {

/// Points that stand side by side.
constexpr Index kBlock = 64;

/// What is summed over the degrees of one order.
struct OrderSeries {
  std::vector<LegendreRecurrence> recurrence;  ///< of the degrees above the order
  RowMatrix coefficients;                      ///< [cosines of all fields, then sines x degrees]

  OrderSeries(const Matrix& all, int order, int m) {
    const Index n_fields = all.cols();
    coefficients.resize((m == 0 ? 1 : 2) * n_fields, order + 1 - m);
    for (int n = m; n <= order; ++n) {
      if (n > m) recurrence.push_back(legendre_recurrence(n, m));
      coefficients.col(n - m).head(n_fields) = all.row(coefficient_index(n, m)).transpose();
      if (m > 0) coefficients.col(n - m).tail(n_fields) = all.row(coefficient_index(n, -m)).transpose();
    }
  }
};

/// Cosine and sine of θ, then of φ.
using Waves = Eigen::Matrix<double, Eigen::Dynamic, 4>;

/// Values of all fields at a block of points, [fields x points].
RowMatrix values_at(const std::vector<OrderSeries>& series, const Eigen::Ref<const Waves>& waves) {
  using Block = Eigen::Array<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kBlock>;
  const Index n_points = waves.rows(), n_fields = series.front().coefficients.rows();
  const Index width = filled_up(n_points);
  const auto filled = [&](Index wave) {
    Block block = Block::Zero(width);
    block.head(n_points) = waves.col(wave).array().transpose();
    return block;
  };
  const Block cos_theta = filled(0), sin_theta = filled(1), cos_phi = filled(2), sin_phi = filled(3);
  Block cos_m = Block::Ones(width), sin_m = Block::Zero(width);
  Block sectoral = Block::Constant(width, 1.0 / std::sqrt(4.0 * std::numbers::pi));
  RowMatrix legendre(series.front().coefficients.cols(), width), sums(2 * n_fields, width);
  RowMatrix values = RowMatrix::Zero(n_fields, width);
  for (std::size_t m = 0; m < series.size(); ++m) {
    const auto& [recurrence, coefficients] = series[m];
    if (m > 0) {
      sectoral *= legendre_sectoral_factor(static_cast<int>(m)) * sin_theta;
      const Block next = cos_m * cos_phi - sin_m * sin_phi;
      sin_m = sin_m * cos_phi + cos_m * sin_phi;
      cos_m = next;
    }
    legendre.row(0) = sectoral.matrix();
    for (Index i = 1; i < coefficients.cols(); ++i) {
      const LegendreRecurrence& r = recurrence[static_cast<std::size_t>(i - 1)];
      auto next = legendre.row(i).array();
      next = r.a * cos_theta * legendre.row(i - 1).array();
      if (i > 1) next -= r.a * r.b * legendre.row(i - 2).array();
    }
    small_product(coefficients.rows(), coefficients.cols(), width, {coefficients.data(), coefficients.cols(), 1},
                  legendre.data(), width, sums.data(), width);
    for (Index f = 0; f < n_fields; ++f) {
      values.row(f).array() += sums.row(f).array() * cos_m;
      if (m > 0) values.row(f).array() += sums.row(n_fields + f).array() * sin_m;
    }
  }
  return values.leftCols(n_points);
}

Matrix values_of(const Matrix& coefficients, const Waves& waves, int azimuthal_order) {
  const int order = order_of(coefficients.rows());
  const Index n_points = waves.rows();
  std::vector<OrderSeries> series;
  for (int m = 0; m <= std::min(order, azimuthal_order); ++m) series.emplace_back(coefficients, order, m);
  Matrix values(n_points, coefficients.cols());
  // Terms below which waking a second thread costs more than it saves.
  constexpr Index kParallelTerms = 30000;
  const Index terms = n_points * (order + 1) * (azimuthal_order + 1);
  for_each_index((n_points + kBlock - 1) / kBlock, terms > kParallelTerms, [&](Index block) {
    const Index start = block * kBlock, size = std::min(kBlock, n_points - start);
    values.middleRows(start, size) = values_at(series, waves.middleRows(start, size)).transpose();
  });
  return values;
}

}  // namespace

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi) {
  return evaluate_harmonics(coefficients, theta, phi, order_of(coefficients.rows()));
}

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi, int azimuthal_order) {
  require_size("phi", phi.size(), theta.size());
  Waves waves(theta.size(), 4);
  waves << theta.array().cos(), theta.array().sin(), phi.array().cos(), phi.array().sin();
  return values_of(coefficients, waves, azimuthal_order);
}

Matrix evaluate_harmonics(const Matrix& coefficients, const Matrix& directions, int azimuthal_order) {
  require_size("directions (Cartesian components)", directions.cols(), 3);
  Waves waves(directions.rows(), 4);
  for (Index i = 0; i < directions.rows(); ++i) {
    const double x = directions(i, 0), y = directions(i, 1), z = directions(i, 2);
    const double from_axis = std::sqrt(x * x + y * y), length = std::sqrt(x * x + y * y + z * z);
    waves(i, 0) = z / length;
    waves(i, 1) = from_axis / length;
    // On the axis φ is of no account.
    waves(i, 2) = from_axis > 0.0 ? x / from_axis : 1.0;
    waves(i, 3) = from_axis > 0.0 ? y / from_axis : 0.0;
  }
  return values_of(coefficients, waves, azimuthal_order);
}

}  // namespace vehd
