#include "bie/sphere/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/legendre.hpp"
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

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi) {
  return evaluate_harmonics(coefficients, theta, phi, order_of(coefficients.rows()));
}

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi, int azimuthal_order) {
  require_size("phi", phi.size(), theta.size());
  const int order = order_of(coefficients.rows());
  const Index n_points = theta.size();
  const Index n_fields = coefficients.cols();
  constexpr Index kBlock = 64;
  using Block = Eigen::Array<double, Eigen::Dynamic, 1, 0, kBlock, 1>;
  using BlockFields = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic>;

  Matrix values(n_points, n_fields);
  const Index n_blocks = (n_points + kBlock - 1) / kBlock;
  // Terms below which waking a second thread costs more than it saves.
  constexpr Index kParallelTerms = 30000;
  const Index terms = n_points * (order + 1) * (azimuthal_order + 1);
  for_each_index(n_blocks, terms > kParallelTerms, [&](Index block) {
    const Index start = block * kBlock;
    const Index size = std::min(kBlock, n_points - start);
    const Block cos_theta = theta.segment(start, size).array().cos();
    const Block sin_theta = theta.segment(start, size).array().sin();
    const Block cos_phi = phi.segment(start, size).array().cos();
    const Block sin_phi = phi.segment(start, size).array().sin();
    Block cos_m = Block::Ones(size);
    Block sin_m = Block::Zero(size);
    Block sectoral = Block::Constant(size, 1.0 / std::sqrt(4.0 * std::numbers::pi));
    BlockFields sum = BlockFields::Zero(size, n_fields);
    BlockFields cos_sum(size, n_fields);
    BlockFields sin_sum(size, n_fields);
    for (int m = 0; m <= std::min(order, azimuthal_order); ++m) {
      if (m > 0) {
        sectoral *= legendre_sectoral_factor(m) * sin_theta;
        const Block next = cos_m * cos_phi - sin_m * sin_phi;
        sin_m = sin_m * cos_phi + cos_m * sin_phi;
        cos_m = next;
      }
      Block previous = Block::Zero(size);
      Block current = sectoral;
      cos_sum.setZero();
      sin_sum.setZero();
      for (int n = m; n <= order; ++n) {
        if (n > m) {
          const LegendreRecurrence r = legendre_recurrence(n, m);
          const Block next = r.a * (cos_theta * current - r.b * previous);
          previous = current;
          current = next;
        }
        for (Index f = 0; f < n_fields; ++f) {
          cos_sum.col(f) += coefficients(coefficient_index(n, m), f) * current;
          if (m > 0) sin_sum.col(f) += coefficients(coefficient_index(n, -m), f) * current;
        }
      }
      for (Index f = 0; f < n_fields; ++f) sum.col(f) += cos_sum.col(f) * cos_m + sin_sum.col(f) * sin_m;
    }
    values.middleRows(start, size) = sum;
  });
  return values;
}

}  // namespace vehd
