#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kOrder = 10;
const Vector3 kCentre(0.3, -0.2, 0.5);
constexpr double kRadius = 1.3;

Matrix off_centre_sphere() { return translated(sphere(kOrder, kRadius), kCentre); }

/// Largest distance of a grid point from the sphere about `centre`.
double distance_from_sphere(const Discretisation& discretisation, const State& state, const Vector3& centre) {
  const Matrix points = discretisation.fine_transform().synthesize(state.position);
  return ((points.rowwise() - centre.transpose()).rowwise().norm().array() - kRadius).abs().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(rigid_sphere)

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
    BOOST_TEST(discretisation.fine_transform().synthesize(end.area_strain).cwiseAbs().maxCoeff() < 1e-7);
  }
}

// V' = −G_m V + κ (3E/2 − V) with V(0) = 0 on the unit sphere: backward Euler, so of first order in dt.
BOOST_AUTO_TEST_CASE(sphere_charges_at_first_order_towards_the_exact_law) {
  const Discretisation discretisation = discretisation_of(kOrder);
  const Model model = field_model();
  const double kappa = 2.0 * 1.0 * 2.0 / (1.0 + 2.0 * 2.0);
  const double rate = model.charging->conductance + kappa;
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

BOOST_AUTO_TEST_SUITE_END()
