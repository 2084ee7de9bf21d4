#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/support/complex_columns.hpp"
#include "tests/physics/coupled_spheres.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/several.hpp"

BOOST_AUTO_TEST_SUITE(coupled_relaxation)

using namespace vehd;
using namespace vehd::testing;

namespace {

using Complex = std::complex<double>;

constexpr double kTight = 1e-13;

ElectricParameters relaxing(const Vector3& field, double conductivity_in = 0.6, double permittivity_ratio = 0.5) {
  ElectricParameters electric{field, conductivity_in, 1.7, 0.4, permittivity_ratio};
  electric.displacement_current = true;
  return electric;
}
constexpr ChargingParameters kMembrane{0.8, 0.3};

SeveralMembranes spheres_above_each_other(int order, double distance) {
  const Vector3 up(0.0, 0.0, distance / 2.0);
  return {order, {translated(sphere(order), -up), translated(sphere(order), up)}, kLaplaceLayers, kLaplacePairs};
}

std::vector<ChargingMembrane> charging_in(const SeveralMembranes& several, const ElectricParameters& electric) {
  return several.charging(electric, std::vector<ChargingParameters>(several.count(), kMembrane));
}

/// Rates of the charges when only leaks and pumps conduct through the membrane.
Unknowns rates_of(const ChargingMembrane& of, const RelaxingField& field) {
  return charge_rates(of, field, current_through(of.in_field.membrane, membrane_current(of), field.potential));
}

std::vector<Unknowns> no_charges(const SeveralMembranes& several) {
  std::vector<Unknowns> all;
  for (const Vector& zero : several.zeros()) all.push_back({{}, zero, zero});
  return all;
}

/// Advances the charges by one step of backward Euler.
void charge(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction, double dt,
            std::vector<Unknowns>& charges) {
  std::vector<Unknowns> reached;
  require_converged(charge_membranes(membranes, interaction, dt, kTight, charges, nullptr, reached), "charges");
  charges = std::move(reached);
}

std::vector<RelaxingField> fields(const std::vector<ChargingMembrane>& membranes, const SeveralMembranes& several,
                                  const std::vector<Unknowns>& charges) {
  std::vector<RelaxingField> found =
      fields_of_charges(membranes, several.interaction, charges, kTight, several.zeros());
  require_converged(found.front().report, "V_m");
  return found;
}

/// Upward force on the lower membrane.
double attraction(const SeveralMembranes& several, const ElectricParameters& electric,
                  const std::vector<RelaxingField>& found) {
  const Matrix force =
      electric_force(electric.permittivity, several.membranes[0], found[0].traces, electric.permittivity_ratio);
  return -total(several.membranes[0], force).z();
}

/// Charges q_i/C, Q/C of an amplitude: K_k E_k = yV, so q_i = C V − ε_i yV/K_i and q_e = ε_e yV/K_e − C V.
std::pair<Matrix, Matrix> charge_amplitudes(const ChargingMembrane& of, double frequency, const Matrix& potential) {
  ElectricParameters electric = of.in_field.electric;
  electric.averaged_frequency = frequency;
  const ComplexConductivities k = complex_conductivities(electric);
  const Complex current = membrane_admittance(of.charging, frequency) / of.charging.capacitance;
  const Matrix inner = times(electric.permittivity * electric.permittivity_ratio * current / k.inside, potential);
  return {potential - inner, times(electric.permittivity * current / k.outside, potential) - inner};
}

}  // namespace

// One implicit step from zero charge is the steady state with fluid conductivities larger by ε/dt and a membrane
// conductance larger by C_m/dt: K_i/K_e and (C_m/dt + G_m)/K_e in the multipoles.
BOOST_AUTO_TEST_CASE(one_step_of_two_spheres_is_that_of_their_multipoles) {
  const SeveralMembranes spheres = spheres_above_each_other(16, 2.5);
  const ElectricParameters electric = relaxing({0.0, 0.0, 1.0}, 6.0);
  const std::vector<ChargingMembrane> membranes = charging_in(spheres, electric);
  for (const double dt : {1e-3, 0.2, 10.0}) {
    std::vector<Unknowns> charges = no_charges(spheres);
    charge(membranes, spheres.interaction, dt, charges);
    const double k_in = 6.0 + 0.2 / dt, k_out = 1.7 + 0.4 / dt;
    const SphereForces exact = charged_sphere_forces(0.5, k_in / k_out, (0.8 / dt + 0.3) / k_out);
    const double found = attraction(spheres, electric, fields(membranes, spheres, charges));
    BOOST_TEST(std::abs(found - 0.4 * exact.along) < 1e-7, "dt = " << dt << ": " << found << ", " << exact.along);
  }
}

// The multipoles use k_m = k/(1 + m K_i/y).
BOOST_AUTO_TEST_CASE(two_spheres_in_an_alternating_field_attract_as_their_complex_multipoles_say) {
  const SeveralMembranes spheres = spheres_above_each_other(16, 2.5);
  ElectricParameters electric = relaxing({0.0, 0.0, 1.0}, 6.0);
  for (const double frequency : {0.03, 0.3, 3.0}) {
    electric.averaged_frequency = frequency;
    const ComplexConductivities k = complex_conductivities(electric);
    const Complex s = k.inside / membrane_admittance(kMembrane, frequency);
    const SphereForces exact = sphere_forces_of(
        0.5, [&](int m) -> Complex { return k.inside / k.outside / (1.0 + static_cast<double>(m) * s); });
    const AveragedFields solved = solve_averaged_fields(charging_in(spheres, electric), spheres.interaction, kTight);
    require_converged(solved.report, "amplitudes");
    const double found = -total(spheres.membranes[0], solved.membranes[0].force).z();
    BOOST_TEST(std::abs(found - 0.4 * exact.along) < 1e-7, frequency << ": " << found << ", " << 0.4 * exact.along);
  }
}

// In the dipole field of the other sphere V grows by −2 g/d³ along the line of centres.
BOOST_AUTO_TEST_CASE(a_sphere_far_away_counts_with_the_third_power_of_its_distance) {
  const ElectricParameters electric = relaxing({0.0, 0.0, 1.0}, 6.0);
  const double dt = 0.2, k_in = 6.0 + 0.2 / dt, k_out = 1.7 + 0.4 / dt, g = (0.8 / dt + 0.3) / k_out;
  const double dipole = polarisability(1, k_in / k_out / (1.0 + k_in / k_out / g));
  for (const double distance : {8.0, 16.0, 32.0}) {
    const SeveralMembranes spheres = spheres_above_each_other(6, distance);
    std::vector<Unknowns> charges = no_charges(spheres);
    charge(charging_in(spheres, electric), spheres.interaction, dt, charges);
    std::vector<Unknowns> alone{no_charges(spheres).front()};
    charge({charging_in(spheres, electric).front()}, {}, dt, alone);
    const Index along = coefficient_index(1, 0);
    const double growth = charges[0].transmembrane_potential[along] / alone[0].transmembrane_potential[along] - 1.0;
    const double expected = -2.0 * dipole / std::pow(distance, 3);
    // The next term comes from the dipoles induced by the dipoles.
    BOOST_TEST(std::abs(growth - expected) < 2.0 * expected * expected + 1e-11, growth << ", " << expected);
  }
}

// Two membranes without symmetry and with different fluids and properties: for the charges of an amplitude the
// potential is the real part of its amplitude, and the rates are those of the alternation.
BOOST_AUTO_TEST_CASE(charges_of_two_membranes_change_as_their_amplitudes_alternate) {
  const SeveralMembranes two(10, {asymmetric_shape(10), translated(ellipsoid(10, {0.8, 0.7, 0.9}), {0.5, 0.3, 2.6})},
                             kLaplaceLayers, kLaplacePairs);
  const Vector3 field(0.4, -0.3, 1.1);
  const std::vector<ChargingMembrane> membranes{{{relaxing(field), two.membranes[0]}, kMembrane},
                                                {{relaxing(field, 3.0, 2.0), two.membranes[1]}, {0.5, 0.1}}};
  const double frequency = 0.2, omega = 2.0 * std::numbers::pi * frequency;
  std::vector<ChargingMembrane> averaged = membranes;
  for (ChargingMembrane& of : averaged) of.in_field.electric.averaged_frequency = frequency;
  const AveragedFields solved = solve_averaged_fields(averaged, two.interaction, kTight);
  std::vector<Unknowns> charges;
  std::vector<Matrix> inner, sum;
  for (std::size_t a = 0; a < 2; ++a) {
    const auto [of_inner, of_sum] = charge_amplitudes(membranes[a], frequency, solved.membranes[a].potential);
    charges.push_back({{}, of_inner.col(0), of_sum.col(0)});
    inner.push_back(of_inner);
    sum.push_back(of_sum);
  }
  const std::vector<RelaxingField> now = fields(membranes, two, charges);
  for (std::size_t a = 0; a < 2; ++a) {
    const Vector potential = solved.membranes[a].potential.col(0);
    BOOST_TEST(max_difference(now[a].potential, potential) < 1e-3 * potential.norm());
    const Unknowns rates = rates_of(membranes[a], now[a]);
    // A quarter of a period later the alternating potential is minus the imaginary part.
    BOOST_TEST(max_difference(rates.transmembrane_potential, -omega * inner[a].col(1)) <
               3e-3 * omega * inner[a].norm());
    BOOST_TEST(max_difference(rates.free_charge, -omega * sum[a].col(1)) < 3e-3 * omega * sum[a].norm());
  }
}

BOOST_AUTO_TEST_CASE(a_step_of_two_membranes_ends_in_charges_whose_field_makes_it) {
  const SeveralMembranes two(
      10, {ellipsoid(10, {1.0, 0.9, 1.1}), translated(ellipsoid(10, {0.8, 0.7, 0.9}), {0.5, 0.3, 2.6})}, kLaplaceLayers,
      kLaplacePairs);
  const Vector3 field(0.4, -0.3, 1.1);
  const std::vector<ChargingMembrane> membranes{{{relaxing(field), two.membranes[0]}, kMembrane},
                                                {{relaxing(field, 3.0, 2.0), two.membranes[1]}, {0.5, 0.1}}};
  const double dt = 0.3;
  std::vector<Unknowns> charges = no_charges(two);
  for (int step = 0; step < 2; ++step) {
    const std::vector<Unknowns> before = charges;
    charge(membranes, two.interaction, dt, charges);
    const std::vector<RelaxingField> now = fields(membranes, two, charges);
    for (std::size_t a = 0; a < 2; ++a) {
      const Unknowns rates = rates_of(membranes[a], now[a]);
      BOOST_TEST(max_difference(dt * rates.transmembrane_potential,
                                charges[a].transmembrane_potential - before[a].transmembrane_potential) <
                 1e-4 * charges[a].transmembrane_potential.norm());
      BOOST_TEST(max_difference(dt * rates.free_charge, charges[a].free_charge - before[a].free_charge) <
                 1e-4 * charges[a].free_charge.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(copies_far_apart_are_each_alone) {
  const Matrix shape = asymmetric_shape(8);
  const SeveralMembranes three(8, {shape, translated(shape, {2e4, 1e4, 0.0}), translated(shape, {0.0, -1e4, 3e4})},
                               kLaplaceLayers, kLaplacePairs);
  const ElectricParameters electric = relaxing({0.4, -0.3, 1.1});
  const std::vector<ChargingMembrane> membranes = charging_in(three, electric);
  std::vector<Unknowns> charges = no_charges(three);
  charge(membranes, three.interaction, 0.3, charges);
  std::vector<Unknowns> alone{no_charges(three).front()};
  charge({membranes.front()}, {}, 0.3, alone);
  const RelaxingField of_one = fields_of_charges({membranes.front()}, {}, alone, kTight, {Vector()}).front();
  const std::vector<RelaxingField> of_all = fields(membranes, three, charges);
  for (std::size_t a = 0; a < 3; ++a) {
    BOOST_TEST(max_difference(charges[a].transmembrane_potential, alone[0].transmembrane_potential) < 1e-10);
    BOOST_TEST(max_difference(charges[a].free_charge, alone[0].free_charge) < 1e-10);
    BOOST_TEST(max_difference(of_all[a].potential, of_one.potential) < 1e-10);
    BOOST_TEST(max_difference(of_all[a].traces.flux_in, of_one.traces.flux_in) < 1e-9);
    BOOST_TEST(max_difference(of_all[a].traces.charge, of_one.traces.charge) < 1e-9);
  }
}

BOOST_AUTO_TEST_SUITE_END()
