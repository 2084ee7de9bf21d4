#include "bie/stepping/evaluation/wrinkling.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "bie/sphere/harmonics.hpp"
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

// A field that flattens a prolate compresses it along its axis; a stronger field compresses it more.
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

// At rest two disturbances share the excess area: the lower degree grows with the area that the higher one releases.
BOOST_AUTO_TEST_CASE(a_disturbance_of_a_compressed_sphere_grows_at_its_rate) {
  constexpr int kOrder = 10;
  constexpr double kRadius = 1.7, kSize = 1e-3;
  const Index low = coefficient_index(2, 1), high = coefficient_index(3, -2);
  const SphereTransform transform(kOrder, make_grid(kOrder));
  const Matrix directions = grid_directions(transform.grid());
  Matrix shape = Matrix::Zero(n_coefficients(kOrder), 1);
  shape(low, 0) = 2.0 * kSize;
  shape(high, 0) = kSize;
  const Vector distance = kRadius * (1.0 + transform.synthesize(shape).col(0).array());
  const Matrix position = transform.analyze(distance.asDiagonal() * directions);
  for (const double viscosity_ratio : {1.0, 4.0}) {
    Model model = relaxation_model(0.3);
    model.viscosity = 0.7;
    model.vesicles[0].viscosity_ratio = viscosity_ratio;
    const Discretisation discretisation = discretisation_of(kOrder);
    const Evaluated found = evaluated(model, discretisation, start(model, discretisation, position, 0.1));
    const double tension = found.diagnostics.tension_integral / found.diagnostics.area;
    const Matrix velocity = transform.synthesize(found.fields.velocity);
    const Vector outward = velocity.cwiseProduct(directions).rowwise().sum();
    const double rate = transform.analyze(outward)(low, 0) / (kRadius * shape(low, 0));
    const FlowParameters flow = flow_parameters(model, model.vesicles[0]);
    const double expected = wrinkling_rate(flow, tension, kRadius, kOrder);
    BOOST_TEST(expected > 0.0);
    BOOST_TEST(found.diagnostics.wrinkling_rate == expected, boost::test_tools::tolerance(1e-5));
    BOOST_TEST(rate == expected, boost::test_tools::tolerance(0.01));
    // Under a tension above that of both disturbances nothing grows.
    BOOST_TEST(wrinkling_rate(flow, 0.0, kRadius, kOrder) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(wrinkles_much_finer_than_the_radius_grow_as_on_a_plane) {
  const double modulus = 0.3, radius = 1.7, tension = -7e4;
  const FlowParameters parameters{.viscosity = 0.7, .viscosity_ratio = 2.5, .bending = BendingParameters{modulus}};
  const double k = std::round(wrinkle_degree(parameters, tension, radius)) / radius;
  const double plane = (-tension * k - 0.5 * modulus * k * k * k) / (2.0 * 0.7 * (1.0 + 2.5));
  BOOST_TEST(wrinkling_rate(parameters, tension, radius, 4000) == plane, boost::test_tools::tolerance(1e-3));
  // Degrees up to 32 do not resolve the fastest-growing wrinkles.
  BOOST_TEST(wrinkling_rate(parameters, tension, radius, 32) < 0.3 * plane);
}

BOOST_AUTO_TEST_SUITE_END()
