#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/potentials/graded_rule.hpp"
#include "bie/support/errors.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(azimuth_sums)

BOOST_AUTO_TEST_CASE(values_and_their_adjoint_are_products_with_the_waves) {
  for (const auto& [order, n_phi] : {std::pair{0, 8}, {1, 4}, {2, 12}, {9, 40}, {16, 44}}) {
    const AzimuthSums sums(n_phi, order);
    Matrix waves(n_phi, sums.n_modes());
    for (int k = 0; k < n_phi; ++k) {
      const double psi = (k + 0.5) * 2.0 * std::numbers::pi / n_phi;
      for (int m = 0; m <= order; ++m) {
        waves(k, m) = std::cos(m * psi);
        if (m > 0) waves(k, order + m) = std::sin(m * psi);
      }
    }
    constexpr Index kWidth = 132;
    const RowMatrix amplitudes = Matrix::Random(sums.n_modes(), kWidth);
    BOOST_TEST((sums.values(amplitudes) - waves * amplitudes).cwiseAbs().maxCoeff() < 1e-13);
    const RowMatrix values = Matrix::Random(n_phi, kWidth);
    BOOST_TEST((sums.adjoint(values) - waves.transpose() * values).cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(azimuths_that_are_no_multiple_of_four_are_refused) {
  BOOST_CHECK_THROW(AzimuthSums(6, 2), ShapeError);
}

BOOST_AUTO_TEST_SUITE_END()
