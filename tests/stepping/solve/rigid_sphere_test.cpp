#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(rigid_sphere, *boost::unit_test::label("slow"))

namespace {

constexpr int kOrder = 8;
const Vector3 kCentre(0.3, -0.2, 0.5);
constexpr double kRadius = 1.3;

Matrix off_centre_sphere() { return translated(sphere(kOrder, kRadius), kCentre); }

/// Largest distance of a grid point from the sphere about `centre`.
double distance_from_sphere(const Discretisation& discretisation, const State& state, const Vector3& centre) {
  const Matrix points = discretisation.vesicle(0).fine_transform().synthesize(state.vesicles[0].position);
  return ((points.rowwise() - centre.transpose()).rowwise().norm().array() - kRadius).abs().maxCoeff();
}

}  // namespace

// Shear (z, 0, 0): the centre moves with the flow there.
BOOST_AUTO_TEST_CASE(sphere_stays_a_sphere_in_flow_and_field) {
  const Discretisation discretisation = discretisation_of(kOrder);
  Model both = field_model();
  both.flow = shear_flow(1.0);
  for (const Model& model : {shear_model(), both}) {
    const double dt = 0.05;
    const State end = run(model, discretisation, start(model, discretisation, off_centre_sphere(), dt), dt, 20);
    const Vector3 centre = kCentre + Vector3(20 * dt * kCentre.z(), 0.0, 0.0);
    BOOST_TEST(distance_from_sphere(discretisation, end, centre) < 1e-10);
    // A rotation strains nothing, however long the step.
    BOOST_TEST(
        discretisation.vesicle(0).fine_transform().synthesize(end.vesicles[0].area_strain).cwiseAbs().maxCoeff() <
        1e-7);
  }
}

// V' = −G_m V + κ (3E/2 − V) with V(0) = 0 on the unit sphere: backward Euler is of first order in dt.
BOOST_AUTO_TEST_CASE(sphere_charges_at_first_order_towards_the_exact_law) {
  const Discretisation discretisation = discretisation_of(kOrder);
  const Model model = field_model();
  const double kappa = 2.0 * 1.0 * 2.0 / (1.0 + 2.0 * 2.0);
  const double rate = model.vesicles[0].charging.conductance + kappa;
  const double exact = 1.5 * kappa / rate * (1.0 - std::exp(-rate * 0.4));
  const auto error = [&](int n_steps) {
    const double dt = 0.4 / n_steps;
    const State end = run(model, discretisation, start(model, discretisation, sphere(kOrder), dt), dt, n_steps);
    return std::abs(evaluated(model, discretisation, end).diagnostics.Vm_north - exact);
  };
  const double coarse = error(10);
  const double fine = error(20);
  BOOST_TEST(coarse < 0.05 * exact);
  BOOST_TEST(std::log2(coarse / fine) > 0.9);
}

namespace {

Discretisation discretisation_of_order(int time_order) {
  NumericalSettings settings;
  settings.order = kOrder;
  settings.time_order = time_order;
  return Discretisation(settings);
}

/// Displacement from kCentre of the centre of a sphere after ten steps to t = 1.
Vector3 travel(const Model& model, int time_order) {
  const Discretisation discretisation = discretisation_of_order(time_order);
  const double dt = 0.1;
  const State end = run(model, discretisation, start(model, discretisation, off_centre_sphere(), dt), dt, 10);
  return centroid(make_surface(discretisation.vesicle(0).fine_transform(), end.vesicles[0].position)) - kCentre;
}

}  // namespace

// Stokes: a sphere of equal viscosities inside, held rigid by its membrane, falls with 2/9 Δρ g R²/μ.
BOOST_AUTO_TEST_CASE(sphere_falls_with_the_velocity_of_stokes_at_every_order) {
  Model model;
  const Vector3 g(0.3, -0.4, -1.2);
  model.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{0.7, g}));
  const Vector3 exact = 2.0 / 9.0 * 0.7 * kRadius * kRadius * g;
  for (int order = 1; order <= highest_time_order; ++order) {
    BOOST_TEST((travel(model, order) - exact).norm() < 1e-8 * exact.norm(), "order " << order);
  }
}

// Faxén: U = v_∞ + R²/6 Δv_∞ at the centre, so a sphere off the axis of v_c (1 − (y² + z²)/a²) lags by 2/3 v_c (R/a)².
BOOST_AUTO_TEST_CASE(sphere_off_the_axis_of_a_tube_lags_as_faxen_says_at_every_order) {
  const double centre_velocity = 0.8, radius = 5.0;
  Model model;
  model.effects.push_back(
      std::make_shared<PoiseuilleFlowEffect>(PoiseuilleParameters{centre_velocity, radius, Waveform{}}));
  const double exact =
      centre_velocity * (1.0 - (kCentre.tail<2>().squaredNorm() + 2.0 / 3.0 * kRadius * kRadius) / (radius * radius));
  for (int order = 1; order <= highest_time_order; ++order) {
    const Vector3 moved = travel(model, order);
    BOOST_TEST(std::abs(moved.x() - exact) < 1e-8 * exact, "order " << order);
    BOOST_TEST(moved.tail<2>().norm() < 1e-8 * exact, "order " << order);
  }
}

// A shear turns a sphere with the vorticity, and a field charges it along a fixed axis: V_m at material points is
// accurate only if the points have rotated by the right angle.
BOOST_AUTO_TEST_CASE(sphere_that_turns_in_a_field_keeps_the_order_of_its_steps) {
  Model model = field_model();
  model.flow = shear_flow(1.0);
  model.vesicles[0].charging.conductance = 0.5;
  const double end_time = 0.8;
  const auto potential = [&](int time_order, int n_steps) {
    const Discretisation discretisation = discretisation_of_order(time_order);
    const double dt = end_time / n_steps;
    const State end = run(model, discretisation, start(model, discretisation, sphere(kOrder), dt), dt, n_steps);
    return evaluated(model, discretisation, end).diagnostics.Vm_max;
  };
  const double exact = potential(5, 32);
  for (const int order : {2, 3, 4}) {
    const double coarse = std::abs(potential(order, 8) - exact), fine = std::abs(potential(order, 16) - exact);
    BOOST_TEST(std::log2(coarse / fine) > order - 0.6, "order " << order << ": " << coarse << ", " << fine);
  }
}

BOOST_AUTO_TEST_SUITE_END()
