#include "bie/sphere/fourier.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace vehd;

namespace {

struct Case {
  int n_phi, order, rows;
};

/// Lengths with and without a centre of the quarter circle, and with a large prime.
constexpr Case kCases[] = {{6, 2, 3}, {10, 4, 1}, {34, 16, 17}, {66, 16, 5}, {74, 32, 33}, {130, 64, 3}, {260, 64, 18}};

/// Amplitudes of a mode in a row at [mode * stride + row], with room between the modes.
Matrix random_amplitudes(const Case& c) {
  std::srand(5);
  return Matrix::Random(c.rows + 2, 2 * c.order + 1);
}

Vector sums_by_definition(const Case& c, const Matrix& amplitudes) {
  Vector values = Vector::Zero(Index{c.rows} * c.n_phi);
  for (int row = 0; row < c.rows; ++row) {
    for (int k = 0; k < c.n_phi; ++k) {
      const double phi = 2.0 * std::numbers::pi * k / c.n_phi;
      double& value = values[row * c.n_phi + k];
      value = amplitudes(row, 0);
      for (int m = 1; m <= c.order; ++m) {
        value += amplitudes(row, m) * std::cos(m * phi) + amplitudes(row, c.order + m) * std::sin(m * phi);
      }
    }
  }
  return values;
}

/// Both ways of one method against the definition and against each other.
template <typename Method>
void check(const Case& c) {
  const Method method(c.n_phi, c.order);
  const Matrix amplitudes = random_amplitudes(c);
  Vector values = Vector::Constant(Index{c.rows} * c.n_phi, 7.0);
  method.synthesize(c.rows, amplitudes.data(), amplitudes.rows(), values.data());
  BOOST_TEST((values - sums_by_definition(c, amplitudes)).cwiseAbs().maxCoeff() < 1e-12, c.n_phi);
  Matrix found(2 * c.order + 1, c.rows);
  method.analyze(c.rows, values.data(), found.data());
  BOOST_TEST((found - amplitudes.topRows(c.rows).transpose()).cwiseAbs().maxCoeff() < 1e-13, c.n_phi);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fourier)

BOOST_AUTO_TEST_CASE(products_over_a_quarter_are_the_sums) {
  for (const Case& c : kCases) check<FourierSums>(c);
}

BOOST_AUTO_TEST_CASE(fast_transforms_are_the_same_sums) {
  for (const Case& c : kCases) check<FastFourier>(c);
}

BOOST_AUTO_TEST_SUITE_END()
