#include "fem_check/cell_kernel.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fem_check/space.hpp"

namespace vehd::fem_check {

namespace {

using Map = CellKernel::Map;
using Tables = CellKernel::Tables;
using Functions = CellKernel::Functions;

/// Symmetry of a map under reflection of the edge: derivatives change sign.
enum class Mirrored { same, opposite };

/// Σ_i m(o, i) in(i) along one direction of in[n_outer][n_in][stride].
template <int n_in, int n_out, int stride, int n_outer, Mirrored mirrored, bool add>
void sum_along(const Map& map, const Lanes* in, Lanes* out) {
  constexpr int pairs = n_in / 2, half = (n_in + 1) / 2, rows = n_out / 2;
  const auto put = [](Lanes& to, const Lanes& value) {
    if constexpr (add) {
      to += value;
    } else {
      to = value;
    }
  };
  for (int outer = 0; outer < n_outer; ++outer) {
    for (int s = 0; s < stride; ++s) {
      const Lanes* x = in + outer * n_in * stride + s;
      Lanes* y = out + outer * n_out * stride + s;
      Lanes sums[half], differences[pairs];
#pragma GCC unroll 16
      for (int i = 0; i < pairs; ++i) {
        sums[i] = x[i * stride] + x[(n_in - 1 - i) * stride];
        differences[i] = x[i * stride] - x[(n_in - 1 - i) * stride];
      }
      if constexpr (half > pairs) sums[pairs] = x[pairs * stride];
#pragma GCC unroll 16
      for (int row = 0; row < (n_out + 1) / 2; ++row) {
        const double* of_sums = map.of_sums.data() + row * half;
        const double* of_differences = map.of_differences.data() + row * pairs;
        const bool middle = row == rows;
        Lanes even = of_sums[0] * sums[0], odd = of_differences[0] * differences[0];
#pragma GCC unroll 16
        for (int i = 1; i < half; ++i) even += of_sums[i] * sums[i];
#pragma GCC unroll 16
        for (int i = 1; i < pairs; ++i) odd += of_differences[i] * differences[i];
        // At the middle of the edge one of the two vanishes.
        if (middle) {
          put(y[row * stride], mirrored == Mirrored::same ? even : odd);
        } else {
          put(y[row * stride], even + odd);
          put(y[(n_out - 1 - row) * stride], mirrored == Mirrored::same ? even - odd : odd - even);
        }
      }
    }
  }
}

/// Sum factorisation with n nodes and q points per direction.
template <int n, int q>
struct Sums {
  static constexpr int n_points = q * q * q;

  static void values(const Tables& tables, const Lanes* nodal, Lanes* at_points) {
    Lanes first[q * n * n], second[q * q * n];
    sum_along<n, q, 1, n * n, Mirrored::same, false>(tables.value, nodal, first);
    sum_along<n, q, q, n, Mirrored::same, false>(tables.value, first, second);
    sum_along<n, q, q * q, 1, Mirrored::same, false>(tables.value, second, at_points);
  }
  static void gradients(const Tables& tables, const Lanes* nodal, Lanes* at_points) {
    Lanes at[n_points];
    values(tables, nodal, at);
    sum_along<q, q, 1, q * q, Mirrored::opposite, false>(tables.slope, at, at_points);
    sum_along<q, q, q, q, Mirrored::opposite, false>(tables.slope, at, at_points + n_points);
    sum_along<q, q, q * q, 1, Mirrored::opposite, false>(tables.slope, at, at_points + 2 * n_points);
  }
  static void integrate_values(const Tables& tables, Lanes* at_points, Lanes* nodal) {
    Lanes first[q * q * n], second[q * n * n];
    sum_along<q, n, q * q, 1, Mirrored::same, false>(tables.value_transposed, at_points, first);
    sum_along<q, n, q, n, Mirrored::same, false>(tables.value_transposed, first, second);
    sum_along<q, n, 1, n * n, Mirrored::same, false>(tables.value_transposed, second, nodal);
  }
  static void integrate_gradients(const Tables& tables, Lanes* at_points, Lanes* nodal) {
    Lanes at[n_points];
    sum_along<q, q, 1, q * q, Mirrored::opposite, false>(tables.slope_transposed, at_points, at);
    sum_along<q, q, q, q, Mirrored::opposite, true>(tables.slope_transposed, at_points + n_points, at);
    sum_along<q, q, q * q, 1, Mirrored::opposite, true>(tables.slope_transposed, at_points + 2 * n_points, at);
    integrate_values(tables, at, nodal);
  }
  static constexpr Functions functions{values, gradients, integrate_values, integrate_gradients};
};

template <int degree = 1>
Functions functions_of(int of_degree, int n_points) {
  if constexpr (degree > highest_degree) {
    throw std::invalid_argument("no sums over " + std::to_string(n_points) + " points per direction for degree " +
                                std::to_string(of_degree));
  } else {
    if (degree == of_degree && n_points == degree + 1) return Sums<degree + 1, degree + 1>::functions;
    if (degree == of_degree && n_points == degree + 2) return Sums<degree + 1, degree + 2>::functions;
    if (degree == of_degree && n_points == degree + 3) return Sums<degree + 1, degree + 3>::functions;
    return functions_of<degree + 1>(of_degree, n_points);
  }
}

/// Map with the entries m, which satisfy m(last − o, last − i) = ± m(o, i).
Map mirrored_map(const Eigen::MatrixXd& m) {
  const Eigen::Index n = m.cols(), half = (n + 1) / 2, rows = (m.rows() + 1) / 2;
  Map map;
  map.of_sums.resize(static_cast<std::size_t>(rows * half));
  map.of_differences.resize(static_cast<std::size_t>(rows * (n / 2)));
  double *sums = map.of_sums.data(), *differences = map.of_differences.data();
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index i = 0; i < n / 2; ++i) {
      *sums++ = 0.5 * (m(row, i) + m(row, n - 1 - i));
      *differences++ = 0.5 * (m(row, i) - m(row, n - 1 - i));
    }
    if (half > n / 2) *sums++ = m(row, n / 2);
  }
  return map;
}

Tables tables_of(int degree, int n_points) {
  const std::vector<dealii::Point<1>> points = dealii::QGauss<1>(static_cast<unsigned>(n_points)).get_points();
  const auto nodal = edge_polynomials(static_cast<unsigned>(degree));
  // Lagrange polynomials of the Gauss points, of degree n_points − 1.
  const auto at_points = dealii::Polynomials::generate_complete_Lagrange_basis(points);
  Eigen::MatrixXd value(n_points, degree + 1), slope(n_points, n_points);
  std::vector<double> derivatives(2);
  for (int q = 0; q < n_points; ++q) {
    const double x = points[static_cast<std::size_t>(q)][0];
    for (int i = 0; i <= degree; ++i) value(q, i) = nodal[static_cast<std::size_t>(i)].value(x);
    for (int i = 0; i < n_points; ++i) {
      at_points[static_cast<std::size_t>(i)].value(x, derivatives);
      slope(q, i) = derivatives[1];
    }
  }
  return {mirrored_map(value), mirrored_map(value.transpose()), mirrored_map(slope), mirrored_map(slope.transpose())};
}

}  // namespace

CellKernel::CellKernel(int degree, int n_points)
    : n_points_(static_cast<unsigned>(n_points * n_points * n_points)),
      functions_(functions_of(degree, n_points)),
      tables_(std::make_shared<const Tables>(tables_of(degree, n_points))) {}

}  // namespace vehd::fem_check
