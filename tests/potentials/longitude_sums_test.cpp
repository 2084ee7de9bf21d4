#include "bie/potentials/longitude_sums.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <iterator>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(longitude_sums)

BOOST_AUTO_TEST_CASE(amplitudes_of_a_sum_of_waves_are_its_coefficients) {
  for (const auto& [order, n_phi] : {std::pair{1, 4}, {8, 18}, {9, 20}, {16, 34}, {8, 24}}) {
    const SphereGrid grid = make_grid(order, n_phi);
    const LongitudeSums sums(grid, order);
    constexpr Index kWidth = 100;
    const std::vector<int>& orders = sums.orders();
    const auto n_modes = std::ssize(orders);
    BOOST_TEST(n_modes == 2 * order + 1);
    const Matrix coefficients = Matrix::Random(n_modes, kWidth);
    Matrix waves(n_phi, n_modes);
    for (int k = 0; k < n_phi; ++k) {
      for (Index mode = 0; mode < n_modes; ++mode) {
        const int m = orders[static_cast<std::size_t>(mode)];
        waves(k, mode) = m < 0 ? std::sin(-m * grid.phi[k]) : std::cos(m * grid.phi[k]);
      }
    }
    const RowMatrix rows = waves * coefficients;
    Vector amplitudes(2 * n_modes * kWidth);
    sums.run(rows.data(), kWidth, {1, 2}, amplitudes.data());
    Matrix found(n_modes, kWidth);
    for (Index first = 0; first < kWidth; first += LongitudeSums::kPiece) {
      const Index count = std::min(LongitudeSums::kPiece, kWidth - first);
      const double* piece = amplitudes.data() + (2 * first + count) * n_modes;
      found.middleCols(first, count) = Eigen::Map<const RowMatrix>(piece, n_modes, count);
    }
    BOOST_TEST((found - coefficients).cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_SUITE_END()
