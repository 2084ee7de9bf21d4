#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/membrane_charging.hpp"
#include "tests/support/electric.hpp"

BOOST_AUTO_TEST_SUITE(charge_relaxation)

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr double kTight = 1e-13;

/// Rates of the given charges.
Unknowns rates_of(const ChargingMembrane& of, const Unknowns& charges) {
  const RelaxingField found = fields_of_charges({of}, {}, {charges}, kTight, {Vector()}).front();
  require_converged(found.report, "V_m");
  return charge_rates(of, found, current_through(of.in_field.membrane, membrane_current(of), found.potential));
}

/// Advances the charges by one step of backward Euler.
void relax(const ChargingMembrane& of, double dt, Unknowns& charges) {
  std::vector<Unknowns> all;
  require_converged(charge_membranes({of}, {}, dt, kTight, {charges}, nullptr, all), "charges");
  charges = all[0];
}

struct RelaxingSphere {
  Space space{6};
  double radius = 1.3;
  Membrane membrane = make_membrane(space, sphere(6, radius), kLaplaceLayers);
  ElectricParameters electric{{0.0, 0.0, 1.1}, 0.6, 1.7, 0.4, 0.5};
  ChargingParameters charging{0.8, 0.3};

  RelaxingSphere() { electric.displacement_current = true; }

  /// Coefficients of f cos θ.
  [[nodiscard]] Vector dipole(double f) const {
    return f / radius * Vector(space.fine.analyze(membrane.surface.position).col(2));
  }
  [[nodiscard]] double amplitude(const Vector& field) const {
    return field[coefficient_index(1, 0)] / dipole(1.0)[coefficient_index(1, 0)];
  }
  /// Rates of the amplitudes (q_i/C, Q/C).
  [[nodiscard]] Eigen::Vector2d rates(double inner, double sum, double field) const {
    ElectricParameters now = electric;
    now.field.z() = field;
    const Unknowns rates = rates_of({{now, membrane}, charging}, {{}, dipole(inner), dipole(sum)});
    return {amplitude(rates.transmembrane_potential), amplitude(rates.free_charge)};
  }
  [[nodiscard]] Eigen::Matrix2d matrix() const {
    Eigen::Matrix2d m;
    m << rates(1.0, 0.0, 0.0), rates(0.0, 1.0, 0.0);
    return m;
  }
};

}  // namespace

// Roots of r²[(2ε_e+ε_i)aC + 2ε_iε_e] + r[(2σ_e+σ_i)aC + (2ε_e+ε_i)aG + 2(σ_iε_e+σ_eε_i)] + (2σ_e+σ_i)aG + 2σ_iσ_e.
BOOST_FIXTURE_TEST_CASE(both_rates_of_a_sphere_are_the_roots_of_its_quadratic, RelaxingSphere) {
  for (const double ratio : {0.1, 0.5, 1.0, 10.0}) {
    for (const double permittivity_ratio : {0.5, 1.0, 2.0}) {
      electric.conductivity_in = ratio * electric.conductivity_out;
      electric.permittivity_ratio = permittivity_ratio;
      const double si = electric.conductivity_in, se = electric.conductivity_out;
      const double ee = electric.permittivity, ei = permittivity_ratio * ee;
      const double ac = radius * charging.capacitance, ag = radius * charging.conductance;
      const double a = (2 * ee + ei) * ac + 2 * ei * ee;
      const double b = (2 * se + si) * ac + (2 * ee + ei) * ag + 2 * (si * ee + se * ei);
      const double c = (2 * se + si) * ag + 2 * si * se;
      const Eigen::Matrix2d m = matrix();
      BOOST_TEST(std::abs(-m.trace() - b / a) < 1e-9 * b / a, ratio << ", " << permittivity_ratio);
      BOOST_TEST(std::abs(m.determinant() - c / a) < 1e-9 * c / a, ratio << ", " << permittivity_ratio);
    }
  }
}

BOOST_FIXTURE_TEST_CASE(each_step_is_backward_euler_exactly, RelaxingSphere) {
  const double dt = 0.4;
  const Eigen::Vector2d drive = rates(0.0, 0.0, electric.field.z());
  Eigen::Vector2d exact(0.2, -0.1);
  Unknowns charges{{}, dipole(exact[0]), dipole(exact[1])};
  for (int i = 0; i < 3; ++i) {
    exact = (Eigen::Matrix2d::Identity() - dt * matrix()).inverse() * (exact + dt * drive);
    relax({{electric, membrane}, charging}, dt, charges);
  }
  BOOST_TEST(max_difference(charges.transmembrane_potential, dipole(exact[0])) < 1e-10);
  BOOST_TEST(max_difference(charges.free_charge, dipole(exact[1])) < 1e-10);
}

BOOST_FIXTURE_TEST_CASE(steady_charges_do_not_change, RelaxingSphere) {
  const ChargingMembrane of{{electric, membrane}, charging};
  std::vector<Vector> potentials(1);
  require_converged(steady_potentials({of}, {}, kTight, potentials), "steady V_m");
  const Unknowns charges = steady_charges(of, potentials[0]);
  const Eigen::Vector2d rate =
      rates(amplitude(charges.transmembrane_potential), amplitude(charges.free_charge), electric.field.z());
  BOOST_TEST(rate.norm() < 1e-10);
}

BOOST_AUTO_TEST_CASE(small_permittivity_is_the_leaky_dielectric_on_any_shape) {
  const Space space(8);
  const Membrane membrane = make_membrane(space, asymmetric_shape(8), kLaplaceLayers);
  ElectricParameters electric{{0.4, -0.3, 1.1}, 0.6, 1.7, 1e-7, 0.5};
  const ChargingParameters charging{0.8, 0.3};
  Unknowns leaky_charges{{}, Vector::Zero(n_coefficients(8))};
  relax({{electric, membrane}, charging}, 0.3, leaky_charges);
  const Vector& leaky = leaky_charges.transmembrane_potential;
  electric.displacement_current = true;
  Unknowns charges{{}, Vector::Zero(leaky.size()), Vector::Zero(leaky.size())};
  relax({{electric, membrane}, charging}, 0.3, charges);
  BOOST_TEST(max_difference(charges.transmembrane_potential, leaky) < 1e-5 * leaky.norm());
}

BOOST_AUTO_TEST_CASE(a_step_ends_in_charges_whose_field_makes_that_step) {
  // Backward Euler: the change is dt times the rate at the end, recomputed from the charges there.
  const Space space(12);
  const Membrane membrane = make_membrane(space, asymmetric_shape(12), kLaplaceLayers);
  ElectricParameters electric{{0.4, -0.3, 1.1}, 0.6, 1.7, 0.4, 0.5};
  electric.displacement_current = true;
  const ChargingParameters charging{0.8, 0.3};
  const double dt = 0.3;
  Unknowns charges{{}, Vector::Zero(n_coefficients(12)), Vector::Zero(n_coefficients(12))};
  relax({{electric, membrane}, charging}, dt, charges);
  const Unknowns rates = rates_of({{electric, membrane}, charging}, charges);
  BOOST_TEST(max_difference(dt * rates.transmembrane_potential, charges.transmembrane_potential) <
             1e-3 * charges.transmembrane_potential.norm());
  BOOST_TEST(max_difference(dt * rates.free_charge, charges.free_charge) < 3e-3 * charges.free_charge.norm());
}

BOOST_AUTO_TEST_SUITE_END()
