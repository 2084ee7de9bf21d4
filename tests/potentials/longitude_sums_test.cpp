#include "bie/potentials/longitude_sums.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(longitude_sums)

BOOST_AUTO_TEST_CASE(amplitudes_of_a_sum_of_waves_are_its_coefficients) {
  for (const auto& [order, n_phi] : {std::pair{1, 4}, {8, 18}, {9, 20}, {16, 34}, {8, 24}}) {
    const SphereGrid grid = make_grid(order, n_phi);
    const LongitudeSums sums(grid, order);
    constexpr Index kWidth = 100;
    const Matrix coefficients = Matrix::Random(sums.n_modes(), kWidth);
    Matrix waves(n_phi, sums.n_modes());
    for (int k = 0; k < n_phi; ++k) {
      for (int m = 0; m <= order; ++m) {
        waves(k, m) = std::cos(m * grid.phi[k]);
        if (m > 0) waves(k, order + m) = std::sin(m * grid.phi[k]);
      }
    }
    const RowMatrix rows = waves * coefficients;
    RowMatrix found(sums.n_modes(), kWidth);
    std::vector<double*> places;
    for (Index mode = 0; mode < sums.n_modes(); ++mode) places.push_back(found.row(mode).data());
    sums.run(rows.data(), kWidth, places, {});
    BOOST_TEST((found - coefficients).cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_SUITE_END()
