#include "bie/stepping/evaluation/wrinkling.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(wrinkling)

BOOST_AUTO_TEST_CASE(the_fastest_wrinkle_is_the_maximum_of_the_growth_rate) {
  const double modulus = 0.3, tension = -7.0, radius = 1.7;
  const FlowParameters parameters{.bending = BendingParameters{modulus}};
  const auto growth = [&](double degree) {
    const double k = degree / radius;
    return -tension * k - 0.5 * modulus * k * k * k;
  };
  const double fastest = wrinkle_degree(parameters, tension, radius);
  BOOST_TEST(growth(fastest) > growth(1.001 * fastest));
  BOOST_TEST(growth(fastest) > growth(0.999 * fastest));
  BOOST_TEST(wrinkle_degree(parameters, 1.0, radius) == 0.0);
  BOOST_TEST(wrinkle_degree({}, -1.0, radius) == std::numeric_limits<double>::infinity());
}

// A field that flattens a prolate compresses it along its axis, the more the stronger it is.
BOOST_AUTO_TEST_CASE(a_compressed_membrane_says_so) {
  const Discretisation discretisation = discretisation_of(8);
  const auto degree_in = [&](double field) {
    Model model = field_model();
    model.electric->field *= field;
    return evaluated(model, discretisation, start(model, discretisation, prolate(8), 0.1)).diagnostics.wrinkle_degree;
  };
  const double weak = degree_in(10.0), strong = degree_in(100.0);
  BOOST_TEST(weak > 1.0);
  BOOST_TEST(strong > 5.0 * weak);
  const Model stretched = [] {
    Model model = relaxation_model(0.1);
    model.flow = axisymmetric_extension(100.0);
    return model;
  }();
  BOOST_TEST(evaluated(stretched, discretisation, start(stretched, discretisation, prolate(8), 0.1))
                 .diagnostics.wrinkle_degree == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
