#include "bie/sphere/harmonics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/sphere/legendre.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/lanes.hpp"
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

/// Points per register, registers summed side by side to hide the latency of the recurrence, and the largest number of
/// fields whose sums stay in registers as well.
#ifdef __AVX512F__
constexpr Index kPointsOfRegister = 2 * kLanes;
constexpr Index kRegisters = 2;
#else
constexpr Index kPointsOfRegister = kLanes;
constexpr Index kRegisters = 1;
#endif
constexpr Index kGroup = kRegisters * kPointsOfRegister;
constexpr Index kMostFields = 5;
/// Groups that one thread takes at a time.
constexpr Index kGroupsTogether = 4;

using PointLanes = Lanes<kPointsOfRegister>::Values;

/// cos θ, sin θ, cos φ and sin φ of the points, padded to whole groups.
using Waves = Eigen::Matrix<double, Eigen::Dynamic, 4>;

Waves waves_of(Index n_points) { return Waves::Zero((n_points + kGroup - 1) / kGroup * kGroup, 4); }

/// Recurrences and coefficients in the order of summation: orders m, and for each the degrees n.
struct Series {
  int order, azimuthal_order;
  Index n_fields;
  std::vector<LegendreRecurrence> recurrence;  ///< of T(n, m) from T(n − 1, m) and T(n − 2, m); zero at n = m
  std::vector<double> coefficients;            ///< per degree those of cosines of all fields, then of sines

  /// @param fields  coefficients, at most kMostFields columns
  Series(const Eigen::Ref<const Matrix>& fields, int highest_degree, int highest_order)
      : order(highest_degree), azimuthal_order(highest_order), n_fields(fields.cols()) {
    for (int m = 0; m <= azimuthal_order; ++m) {
      for (int n = m; n <= order; ++n) {
        recurrence.push_back(n > m ? legendre_recurrence(n, m) : LegendreRecurrence{0.0, 0.0});
        for (Index f = 0; f < n_fields; ++f) coefficients.push_back(fields(coefficient_index(n, m), f));
        for (Index f = 0; f < n_fields; ++f) {
          coefficients.push_back(m > 0 ? fields(coefficient_index(n, -m), f) : 0.0);
        }
      }
    }
  }
};

/// Sums of all fields at one group of points.
template <int kFields>
void sum_at_group(const Series& series, const Waves& waves, Index first, Eigen::Ref<Matrix> values) {
  using Group = std::array<PointLanes, kRegisters>;
  const auto loaded = [&](Index wave) {
    Group group;
    std::memcpy(&group, waves.col(wave).data() + first, sizeof group);
    return group;
  };
  const Group cos_theta = loaded(0), sin_theta = loaded(1), cos_phi = loaded(2), sin_phi = loaded(3);
  Group cos_m, sin_m{}, sectoral, sum[kFields] = {};
  for (Index i = 0; i < kRegisters; ++i) {
    cos_m[i] = PointLanes{} + 1.0;
    sectoral[i] = PointLanes{} + 1.0 / std::sqrt(4.0 * std::numbers::pi);
  }
  const LegendreRecurrence* next = series.recurrence.data();
  const double* coefficient = series.coefficients.data();
  for (int m = 0; m <= series.azimuthal_order; ++m) {
    if (m > 0) {
      const double factor = legendre_sectoral_factor(m);
      for (Index i = 0; i < kRegisters; ++i) {
        sectoral[i] *= factor * sin_theta[i];
        const PointLanes turned = cos_m[i] * cos_phi[i] - sin_m[i] * sin_phi[i];
        sin_m[i] = sin_m[i] * cos_phi[i] + cos_m[i] * sin_phi[i];
        cos_m[i] = turned;
      }
    }
    Group value = sectoral, before{}, cosines[kFields] = {}, sines[kFields] = {};
    for (int n = m; n <= series.order; ++n, ++next, coefficient += 2 * kFields) {
      if (n > m) {
        const double a = next->a, ab = next->a * next->b;
#pragma GCC unroll 2
        for (Index i = 0; i < kRegisters; ++i) {
          const PointLanes above = a * cos_theta[i] * value[i] - ab * before[i];
          before[i] = value[i];
          value[i] = above;
        }
      }
#pragma GCC unroll 8
      for (int f = 0; f < kFields; ++f) {
#pragma GCC unroll 2
        for (Index i = 0; i < kRegisters; ++i) {
          cosines[f][i] += coefficient[f] * value[i];
          sines[f][i] += coefficient[kFields + f] * value[i];
        }
      }
    }
#pragma GCC unroll 8
    for (int f = 0; f < kFields; ++f) {
#pragma GCC unroll 2
      for (Index i = 0; i < kRegisters; ++i) sum[f][i] += cosines[f][i] * cos_m[i] + sines[f][i] * sin_m[i];
    }
  }
  const Index count = std::min(kGroup, values.rows() - first);
  for (int f = 0; f < kFields; ++f) {
    std::memcpy(values.col(f).data() + first, &sum[f], static_cast<std::size_t>(count) * sizeof(double));
  }
}

/// @param waves  of the points that the rows of `values` belong to
void sum_series(const Series& series, const Waves& waves, Eigen::Ref<Matrix> values) {
  static constexpr auto sums = []<int... kBefore>(std::integer_sequence<int, kBefore...>) {
    return std::array{&sum_at_group<kBefore + 1>...};
  }
  (std::make_integer_sequence<int, kMostFields>());
  const auto sum_at = sums[static_cast<std::size_t>(series.n_fields - 1)];
  // Terms below which waking a second thread costs more than it saves.
  constexpr Index kParallelTerms = 1000000;
  const Index terms = values.rows() * (series.order + 1) * (series.azimuthal_order + 1);
  constexpr Index kTogether = kGroupsTogether * kGroup;
  for_each_index((values.rows() + kTogether - 1) / kTogether, terms > kParallelTerms, [&](Index block) {
    const Index end = std::min((block + 1) * kTogether, values.rows());
    for (Index first = block * kTogether; first < end; first += kGroup) sum_at(series, waves, first, values);
  });
}

/// Values at the points, [n_points x n_fields].
Matrix values_of(const Matrix& coefficients, const Waves& waves, Index n_points, int azimuthal_order) {
  const int order = order_of(coefficients.rows());
  Matrix values(n_points, coefficients.cols());
  for (Index first = 0; first < coefficients.cols(); first += kMostFields) {
    const Index count = std::min(kMostFields, coefficients.cols() - first);
    const Series series(coefficients.middleCols(first, count), order, std::min(order, azimuthal_order));
    sum_series(series, waves, values.middleCols(first, count));
  }
  return values;
}

}  // namespace

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi) {
  return evaluate_harmonics(coefficients, theta, phi, order_of(coefficients.rows()));
}

Matrix evaluate_harmonics(const Matrix& coefficients, const Vector& theta, const Vector& phi, int azimuthal_order) {
  require_size("phi", phi.size(), theta.size());
  const Index n_points = theta.size();
  Waves waves = waves_of(n_points);
  waves.topRows(n_points) << theta.array().cos(), theta.array().sin(), phi.array().cos(), phi.array().sin();
  return values_of(coefficients, waves, n_points, azimuthal_order);
}

Matrix evaluate_harmonics(const Matrix& coefficients, const Matrix& directions, int azimuthal_order) {
  require_size("directions (Cartesian components)", directions.cols(), 3);
  Waves waves = waves_of(directions.rows());
  for (Index i = 0; i < directions.rows(); ++i) {
    const double x = directions(i, 0), y = directions(i, 1), z = directions(i, 2);
    const double from_axis = std::sqrt(x * x + y * y), length = std::sqrt(x * x + y * y + z * z);
    waves(i, 0) = z / length;
    waves(i, 1) = from_axis / length;
    // On the axis φ is arbitrary.
    waves(i, 2) = from_axis > 0.0 ? x / from_axis : 1.0;
    waves(i, 3) = from_axis > 0.0 ? y / from_axis : 0.0;
  }
  return values_of(coefficients, waves, directions.rows(), azimuthal_order);
}

}  // namespace vehd
