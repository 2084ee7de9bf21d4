#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/support/thread_count.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// The same surface with its nodes shifted towards +z: n ↦ (n + a ẑ)/|n + a ẑ| of the parameter sphere.
Matrix crowded(int order, const Vector3& axes, double a) {
  const SphereTransform transform(order, make_grid(3 * order));
  Matrix directions = grid_directions(transform.grid());
  directions.col(2).array() += a;
  directions.rowwise().normalize();
  return transform.analyze(directions * axes.asDiagonal());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(hard_steps)

BOOST_AUTO_TEST_CASE(steps_that_grow_and_shrink_by_ten_do_no_harm) {
  const Discretisation discretisation = discretisation_of(12);
  const Model model = field_model();
  const double large = 0.1;
  State state = start(model, discretisation, prolate(12), large);
  State steady = state;
  for (int i = 0; i < 6; ++i) {
    for (const double dt : {large, 0.1 * large}) {
      const StepAttempt result = stepped(model, discretisation, state, dt);
      BOOST_TEST_REQUIRE(result.accepted, result.reason);
      state = result.state;
    }
  }
  steady = run(model, discretisation, steady, 0.5 * large * 1.1, 12);
  const VesicleDiagnostics jumping = evaluated(model, discretisation, state).diagnostics;
  const VesicleDiagnostics even = evaluated(model, discretisation, steady).diagnostics;
  BOOST_TEST(std::abs(state.time - steady.time) < 1e-12);
  BOOST_TEST(std::abs(jumping.area_drift) < 1e-8);
  // First order: uneven steps differ from the even ones by about the error of these, a few percent.
  BOOST_TEST(std::abs(jumping.Vm_north / even.Vm_north - 1.0) < 0.05);
  BOOST_TEST(std::abs(jumping.bending_energy_scaled / even.bending_energy_scaled - 1.0) < 0.01);
}

BOOST_AUTO_TEST_CASE(a_badly_distorted_grid_of_a_good_shape_gives_the_same_motion) {
  const int order = 24;
  const Vector3 axes(1.0, 1.0, 1.5);
  const Discretisation discretisation = discretisation_of(order);
  const Model model = relaxation_model(1.0);
  const auto after = [&](const Matrix& position) {
    const State state = run(model, discretisation, start(model, discretisation, position, 0.02), 0.02, 3);
    return evaluated(model, discretisation, state).diagnostics;
  };
  // Area elements at the poles differ by a factor of about 40.
  const VesicleDiagnostics distorted = after(crowded(order, axes, 0.4));
  const VesicleDiagnostics good = after(ellipsoid(order, axes));
  BOOST_TEST(std::abs(distorted.extent_z / good.extent_z - 1.0) < 1e-4);
  BOOST_TEST(std::abs(distorted.bending_energy_scaled / good.bending_energy_scaled - 1.0) < 1e-3);
  BOOST_TEST(std::abs(distorted.area_drift) < 1e-8);
}

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_the_number_of_threads) {
  const Discretisation discretisation = discretisation_of(12);
  Model model = field_model();
  model.flow = shear_flow(1.0);
  const auto after_a_step = [&](int n_threads) {
    const ThreadCount threads(n_threads);
    return run(model, discretisation, start(model, discretisation, asymmetric_shape(12), 0.02), 0.02, 1);
  };
  const State one = after_a_step(1);
  for (const int n : {2, 3}) {
    const State several = after_a_step(n);
    BOOST_TEST((several.vesicles[0].position - one.vesicles[0].position).norm() <=
               1e-12 * one.vesicles[0].position.norm());
    BOOST_TEST((several.vesicles[0].transmembrane_potential - one.vesicles[0].transmembrane_potential).norm() <=
               1e-12 * one.vesicles[0].transmembrane_potential.norm());
  }
}

BOOST_AUTO_TEST_SUITE_END()
