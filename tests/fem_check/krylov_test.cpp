#include "fem_check/krylov.hpp"

#include <boost/test/unit_test.hpp>

using namespace vehd::fem_check;

/// Solvers that stop on the energy of the true residual.
BOOST_AUTO_TEST_SUITE(krylov)

namespace {

using Pair = dealii::Vector<double>;

/// A diagonal 2 x 2 matrix.
struct Diagonal {
  double first, second;

  void vmult(Pair& to, const Pair& from) const {
    to[0] = first * from[0];
    to[1] = second * from[1];
  }
};

constexpr Diagonal identity{1.0, 1.0};

Pair pair_of(double first, double second) {
  Pair result(2);
  result[0] = first;
  result[1] = second;
  return result;
}

}  // namespace

// The solver measures both components equally. Its first step removes the large one, with almost no energy, and makes
// the other, with nearly all of it, nine times as large: less than a hundredth of the first, so the solver stops there.
BOOST_AUTO_TEST_CASE(energy_may_rise_before_it_falls) {
  const Diagonal a{1.0, 10.0}, energy{1e-8, 1.0};
  const Pair b = pair_of(1.0, 1e-3);
  Pair x(2);
  const double goal = 0.5 * energy_of_residual(energy, b);
  int iterations = 0;
  const double left = generalised_minimal_residuals(a, energy, identity, b, x, goal, iterations, "test");
  BOOST_TEST(left <= goal);
  BOOST_TEST(iterations > 1);
  const Pair residual = pair_of(b[0] - x[0], b[1] - 10.0 * x[1]);
  BOOST_TEST(energy_of_residual(energy, residual) <= goal);
}

BOOST_AUTO_TEST_CASE(residual_that_no_correction_lowers_is_an_error) {
  const Pair b = pair_of(1.0, 1.0);
  Pair x(2);
  int iterations = 0;
  const auto nothing = [](Pair& /*correction*/, const Pair& /*residual*/, double /*size*/) { return 0; };
  BOOST_CHECK_THROW(corrected(identity, identity, b, x, 1e-3, iterations, "test", nothing), SolveError);
}

BOOST_AUTO_TEST_SUITE_END()
