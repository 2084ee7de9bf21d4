#include <boost/test/unit_test.hpp>

#include "bie/physics/membrane_charging.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(electric_solver)

BOOST_AUTO_TEST_CASE(iterations_stay_below_fifteen_for_any_contrast_on_shape_33) {
  for (const int order : {12, 24}) {
    const Space space(order);
    const Membrane membrane = make_membrane(space, shape_33(order), kLaplaceLayers);
    const Vector potential = smooth_coefficients(order, 4, 1, 95);
    for (const double ratio : {1e-8, 1e-3, 0.5, 1.0, 2.0, 1e3, 1e8}) {
      const ElectricParameters electric{{0.4, -0.6, 1.0}, ratio, 1.0, 1.0};
      const Vector rhs = weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential);
      const SecondKindSolution density = solve_second_kind(membrane, conductivity_contrast(electric), rhs, 1e-10);
      BOOST_TEST_CONTEXT("order " << order << ", conductivity ratio " << ratio) {
        BOOST_TEST(density.report.converged());
        BOOST_TEST(density.report.iterations <= 15);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(charging_iterations_are_bounded_for_any_time_constant_on_shape_33) {
  const Space space(12);
  const Membrane membrane = make_membrane(space, shape_33(12), kLaplaceLayers);
  for (const double ratio : {1e-8, 0.5, 1.0, 2.0, 1e8}) {
    for (const double capacitance : {1e-6, 1.0, 1e6}) {
      const ElectricParameters electric{{0.4, -0.6, 1.0}, ratio, 1.0, 1.0};
      std::vector<Unknowns> charged;
      const SolveReport report = charge_membranes({{{electric, membrane}, {capacitance, 0.0}}}, {}, 0.5, 1e-10,
                                                  {{{}, smooth_coefficients(12, 4, 1, 96)}}, nullptr, charged);
      BOOST_TEST_CONTEXT("conductivity ratio " << ratio << ", capacitance " << capacitance) {
        BOOST_TEST(report.converged());
        BOOST_TEST(report.iterations <= 30);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(total_charge_vanishes_at_every_contrast) {
  const Space space(16);
  const Membrane membrane = make_membrane(space, asymmetric_shape(16), kLaplaceLayers);
  const Vector potential = smooth_coefficients(16, 4, 1, 97);
  for (const double ratio : {1e-8, 0.5, 2.0, 1e8}) {
    const ElectricParameters electric{{0.4, -0.6, 1.0}, ratio, 1.0, 1.0};
    const SecondKindSolution density = solve_density(electric, membrane, potential);
    BOOST_TEST(std::abs(density.weighted[0]) < 1e-11 * density.weighted.norm(), "conductivity ratio " << ratio);
  }
}

BOOST_AUTO_TEST_SUITE_END()
