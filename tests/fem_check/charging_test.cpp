#include <boost/test/unit_test.hpp>

#include "fem_check/backward_differentiation.hpp"
#include "tests/fem_check/cases.hpp"

BOOST_AUTO_TEST_SUITE(charging, *boost::unit_test::label("slow"))

namespace {

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// V_m after equal steps from V_m = start·x in the growing field E (1 + t).
Vector charged(const Discretisation& space, const PotentialProblem& membrane, const Vector3& start,
               const TimeSteps& steps) {
  PotentialProblem problem = membrane;
  std::get<ChargingMembrane>(problem.membrane).time_step = implicit_step(steps);
  ChargingSteps charging(space, problem);
  const TimeLaw law{
      [&](const Vector& from, double, double time) { return charging.step(from, (1.0 + time) * problem.field); }};
  return advance(law, charging.rule().position.transpose() * start, steps);
}

PotentialProblem membrane_problem() {
  PotentialProblem problem;
  problem.field = {0.3, -0.2, 0.9};
  problem.conductivity_out = 2.0;
  problem.membrane = ChargingMembrane{1.5, 0.2, 1.0, 1, {}};
  return problem;
}

}  // namespace

// C_m V' = −G_m V + κ (3E/2 − V) with κ = 2 σ_i σ_e/(σ_i + 2σ_e), E = E_1 (1 + t): V = a + b t + (V_0 − a) exp(−r t)
// with r = (G_m + κ)/C_m, b = 3κE_1/(2 C_m r) and a = b − b/r.
BOOST_AUTO_TEST_CASE(sphere_charges_with_order_two) {
  const Discretisation space = discretise(unit_sphere(), {.shell_layers = 3, .degree = 4});
  const PotentialProblem problem = membrane_problem();
  const auto& membrane = std::get<ChargingMembrane>(problem.membrane);
  const double kappa = 2.0 * problem.conductivity_in[0] * problem.conductivity_out /
                       (problem.conductivity_in[0] + 2.0 * problem.conductivity_out);
  const double rate = (membrane.conductance[0] + kappa) / membrane.capacitance[0], end = 1.5;
  const Vector3 slope = 1.5 * kappa / (membrane.capacitance[0] * rate) * problem.field,
                offset = (1.0 - 1.0 / rate) * slope;
  const Vector3 start(0.5, 0.1, -0.4), last = offset + end * slope + std::exp(-rate * end) * (start - offset);
  double before = 0.0;
  for (const int number : {4, 8, 16}) {
    const Vector value = charged(space, problem, start, {0.0, end, number});
    const SurfacePoints points = space.quadrature_points(space.degree() + 2);
    const double error = relative_l2(points, value.transpose(), last.transpose() * points.position);
    if (before > 0.0) {
      const double order = observed_order(before, error, 2.0);
      BOOST_TEST_CONTEXT(number << " steps: " << error << ", order " << order) {
        BOOST_TEST(order > 1.7);
        BOOST_TEST(order < 2.4);
      }
    }
    before = error;
  }
  BOOST_TEST(before < 3e-4);
}

BOOST_AUTO_TEST_CASE(shape_without_symmetry_charges_with_order_two) {
  const vehd::meshes::FrozenShape shape(shapes::project(6, [](const vehd::meshes::Point& r) {
    const double rho = 1.0 + 0.2 * r.x() * r.z() + 0.15 * r.y() * (r.x() + 0.5 * r.z() * r.z());
    return vehd::meshes::Point(rho * r);
  }));
  const Discretisation space = discretise(shape, {.shell_layers = 2, .degree = 2});
  const SurfacePoints points = space.quadrature_points(space.degree() + 2);
  const Vector3 start(0.5, 0.1, -0.4);
  std::vector<Vector> values;
  for (const int number : {4, 8, 16, 32}) {
    values.push_back(charged(space, membrane_problem(), start, {0.0, 1.5, number}));
  }
  const auto change = [&](std::size_t i) {
    return relative_l2(points, values[i].transpose(), values[i + 1].transpose());
  };
  for (const std::size_t i : {0U, 1U}) {
    const double order = observed_order(change(i), change(i + 1), 2.0);
    BOOST_TEST_CONTEXT("changes " << change(i) << ", " << change(i + 1) << ", order " << order) {
      BOOST_TEST(order > 1.7);
      BOOST_TEST(order < 2.4);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
