#include "bie/stepping/solve/constrained_motion.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(constrained_motion_passes)

BOOST_AUTO_TEST_CASE(passes_gain_down_to_rounding) {
  // The strain reaches rounding long before Eq. (28) does, and every pass produces it again.
  Model model = relaxation_model(0.1);
  model.flow = axisymmetric_extension(1.0);
  for (const int order : {8, 12}) {
    for (const double length : {1.3, 1.5, 1.8}) {
      const Matrix position = ellipsoid(order, {1.0, 1.0, length});
      const Discretisation discretisation(solved_to_rounding(order), find_symmetry(model, at_rest(position)));
      for (int i = 0; i < 8; ++i) {
        const double dt = 0.02 * std::pow(1.5, i);
        const State state = start(model, discretisation, position, dt);
        BOOST_CHECK_NO_THROW(run(model, discretisation, state, dt, 6));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
