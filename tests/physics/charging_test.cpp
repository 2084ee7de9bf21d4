#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/membrane_charging.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int charging_order = 8;
constexpr double kTolerance = 1e-13;

/// Sphere of radius 1 in a field along z: V_m = V cos θ with C_m V̇ = −G_m V + κ(3E/2 − V).
struct ChargingSphere {
  Space space{charging_order};
  Membrane membrane = make_membrane(space, sphere(charging_order), kLaplaceLayers);
  ElectricParameters electric{{0.0, 0.0, 1.3}, 1.0, 2.0, 1.0};
  ChargingParameters charging{0.8, 0.6};

  [[nodiscard]] double kappa() const {
    return 2.0 * electric.conductivity_in * electric.conductivity_out /
           (electric.conductivity_in + 2.0 * electric.conductivity_out);
  }
  [[nodiscard]] double steady() const { return 1.5 * electric.field.z() * kappa() / (kappa() + charging.conductance); }
  [[nodiscard]] double exact(double time) const {
    return steady() * -std::expm1(-time * (kappa() + charging.conductance) / charging.capacitance);
  }
  /// Coefficients of V cos θ.
  [[nodiscard]] Vector dipole(double v) const { return v * space.fine.analyze(membrane.surface.position).col(2); }
  /// V_m at `time` after n_steps steps from zero.
  [[nodiscard]] Vector charged(double time, int n_steps) const {
    Vector v = Vector::Zero(n_coefficients(charging_order));
    for (int i = 0; i < n_steps; ++i) {
      charge(time / n_steps, v);
    }
    return v;
  }
  void charge(double dt, Vector& v) const {
    std::vector<Unknowns> charged;
    require_converged(
        charge_membranes({{{electric, membrane}, charging}}, {}, dt, kTolerance, {{{}, v}}, nullptr, charged),
        "charging");
    v = charged[0].transmembrane_potential;
  }
  [[nodiscard]] SolveReport find_steady(Vector& v) const {
    std::vector<Vector> potentials(1);
    const SolveReport report = steady_potentials({{{electric, membrane}, charging}}, {}, kTolerance, potentials);
    v = potentials[0];
    return report;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(charging_sphere, ChargingSphere)

BOOST_AUTO_TEST_CASE(each_step_is_backward_euler_exactly) {
  const double dt = 0.3;
  const double storage = charging.capacitance / dt;
  double v = 0.0;
  for (int i = 0; i < 4; ++i) {
    v = (storage * v + 1.5 * kappa() * electric.field.z()) / (storage + charging.conductance + kappa());
  }
  BOOST_TEST(max_difference(charged(4 * dt, 4), dipole(v)) < 1e-11);
}

BOOST_AUTO_TEST_CASE(approaches_the_exponential_with_first_order) {
  std::array<double, 3> errors{};
  for (int level = 0; level < 3; ++level) {
    errors[level] = max_difference(charged(0.5, 8 << level), dipole(exact(0.5)));
  }
  BOOST_TEST(errors[0] < 0.05);
  BOOST_TEST(std::abs(std::log2(errors[0] / errors[1]) - 1.0) < 0.1);
  BOOST_TEST(std::abs(std::log2(errors[1] / errors[2]) - 1.0) < 0.05);
}

BOOST_AUTO_TEST_CASE(tiny_capacitance_is_steady_after_one_step) {
  charging.capacitance = 1e-6;
  BOOST_TEST(max_difference(charged(1.0, 1), dipole(steady())) < 1e-5);
  BOOST_TEST(max_difference(charged(10.0, 10), dipole(steady())) < 1e-11);
}

BOOST_AUTO_TEST_CASE(steady_potential_is_the_limit_of_long_charging) {
  Vector v;
  require_converged(find_steady(v), "steady potential");
  BOOST_TEST(max_difference(v, dipole(steady())) < 1e-11);
  BOOST_TEST(max_difference(charged(1e9, 4), v) < 1e-8);
}

BOOST_AUTO_TEST_CASE(law_holds_at_extreme_conductivity_ratios) {
  for (const double ratio : {1e-8, 1.0, 1e8}) {
    electric.conductivity_in = ratio;
    electric.conductivity_out = 1.0;
    const double dt = 0.4;
    const double storage = charging.capacitance / dt;
    const double v = 1.5 * kappa() * electric.field.z() / (storage + charging.conductance + kappa());
    BOOST_TEST(max_difference(charged(dt, 1), dipole(v)) < 1e-11, "ratio " << ratio);
  }
}

BOOST_AUTO_TEST_CASE(mean_potential_leaks_through_the_membrane_alone) {
  // No net current leaves a closed membrane: the mean obeys C_m V̇ = −G_m V for every field.
  const double dt = 0.3;
  Vector v = 0.9 * harmonic(charging_order, 0, 0);
  charge(dt, v);
  const double storage = charging.capacitance / dt;
  BOOST_TEST(std::abs(v[0] - 0.9 * storage / (storage + charging.conductance)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(steady_potential_that_nothing_determines_is_an_input_error) {
  electric.conductivity_in = 0.0;
  charging.conductance = 0.0;
  Vector v;
  BOOST_CHECK_THROW(static_cast<void>(find_steady(v)), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
