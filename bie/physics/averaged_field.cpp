#include "bie/physics/averaged_field.hpp"

#include <numbers>
#include <utility>

#include "bie/physics/current_law.hpp"
#include "bie/physics/electric.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/complex_columns.hpp"

namespace vehd {

namespace {

using Complex = std::complex<double>;
using ComplexField = FieldOf<Complex>;

double angular_frequency(double frequency) { return 2.0 * std::numbers::pi * frequency; }

/// Law with a = y, k = K and no given charge.
CurrentLaw<Complex> law_of_amplitudes(const ChargingMembrane& of) {
  const auto& [electric, membrane] = of.in_field;
  const double omega = angular_frequency(*electric.averaged_frequency);
  const ComplexConductivities k = complex_conductivities(electric);
  const ComplexField none = ComplexField::Zero(membrane.surface.n_points());
  Matrix admittance(none.size(), 2);
  admittance << conductance_of(of.charging, membrane), omega * capacitance_of(of.charging, membrane);
  return {from_parts<Complex>(admittance), k.inside, k.outside, none, none};
}

/// If a fluid insulates, no current flows and V_m is zero: the charge is that of a constant field.
TracesOf<Complex> insulated_traces(const ElectricMembrane& of, double tolerance, SolveReport& report) {
  const auto& [electric, membrane] = of;
  const Vector none = Vector::Zero(n_coefficients(membrane.fine.order()));
  const SecondKindSolution density = solve_second_kind(membrane, conductivity_contrast(electric),
                                                       weighted_field_flux(membrane, electric.field), tolerance);
  const int iterations = report.iterations;
  report = density.report;
  report.iterations += iterations;
  const ElectricTraces traces = electric_traces(electric, membrane, none, density);
  return {traces.potential_in, traces.potential_out, traces.flux_in, traces.flux_out, traces.charge};
}

AveragedField field_of(const ElectricMembrane& of, const ComplexField& potential, const TracesOf<Complex>& traces) {
  const auto& [electric, membrane] = of;
  AveragedField field{parts_of(potential), membrane.fine.analyze(parts_of(traces.charge)), {}};
  // Means over a period of products: half the product of the real parts and half that of the imaginary parts.
  const ElectricTraces real{traces.potential_in.real(), traces.potential_out.real(), traces.flux_in.real(),
                            traces.flux_out.real(), traces.charge.real()};
  const ElectricTraces imaginary{traces.potential_in.imag(), traces.potential_out.imag(), traces.flux_in.imag(),
                                 traces.flux_out.imag(), traces.charge.imag()};
  field.force = 0.5 * (electric_force(electric.permittivity, membrane, real, electric.permittivity_ratio) +
                       electric_force(electric.permittivity, membrane, imaginary, electric.permittivity_ratio));
  return field;
}

}  // namespace

ComplexConductivities complex_conductivities(const ElectricParameters& electric) {
  ComplexConductivities k{electric.conductivity_in, electric.conductivity_out};
  if (!electric.displacement_current) return k;
  const double of_permittivity = angular_frequency(*electric.averaged_frequency) * electric.permittivity;
  k.inside += Complex(0.0, of_permittivity * electric.permittivity_ratio);
  k.outside += Complex(0.0, of_permittivity);
  return k;
}

std::complex<double> membrane_admittance(const ChargingParameters& charging, double frequency) {
  return {charging.conductance, angular_frequency(frequency) * charging.capacitance};
}

AveragedFields solve_averaged_fields(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                                     double tolerance) {
  std::vector<CurrentLaw<Complex>> laws;
  for (const ChargingMembrane& one : membranes) laws.push_back(law_of_amplitudes(one));
  std::vector<ComplexField> potentials(membranes.size());
  AveragedFields result;
  result.report = solve_laws(membranes, interaction, laws, tolerance, potentials);
  const bool insulates = laws.front().series() == 0.0;
  std::vector<TracesOf<Complex>> traces;
  if (insulates) {
    traces.push_back(insulated_traces(membranes.front().in_field, tolerance, result.report));
  } else {
    traces = traces_of_laws(membranes, interaction, laws, potentials);
  }
  result.membranes.resize(membranes.size());
  for (const std::size_t a : interaction.partition().local_indices(membranes.size())) {
    result.membranes[a] = field_of(membranes[a].in_field, potentials[a], traces[a]);
  }
  return result;
}

SphereInAcField sphere_in_ac_field(const ElectricParameters& electric, const ChargingParameters& charging,
                                   double radius) {
  const ComplexConductivities k = complex_conductivities(electric);
  const std::complex<double> through = radius * membrane_admittance(charging, *electric.averaged_frequency);
  // Nothing is divided by K_e, which is zero if the fluid outside insulates.
  const std::complex<double> divisor = 2.0 * k.outside + k.inside + 2.0 * k.inside * k.outside / through;
  SphereInAcField sphere;
  sphere.inside = 3.0 * k.outside / divisor;
  sphere.outside = 3.0 * k.inside / divisor;
  sphere.potential = 3.0 * k.inside * k.outside * radius / (divisor * through);
  const std::complex<double> tangential = 1.5 + 0.5 * sphere.outside;
  const double inner = 4.0 * electric.permittivity * electric.permittivity_ratio;
  sphere.drive = electric.permittivity * std::norm(tangential) - inner * std::norm(sphere.inside);
  sphere.alternating_drive = electric.permittivity * tangential * tangential - inner * sphere.inside * sphere.inside;
  return sphere;
}

double ripple_amplitude(const ElectricParameters& electric, const ChargingParameters& charging, double radius,
                        double viscosity, double viscosity_ratio) {
  const double drive = std::abs(sphere_in_ac_field(electric, charging, radius).alternating_drive);
  const double twice_omega = 4.0 * std::numbers::pi * *electric.averaged_frequency;
  return electric.field.squaredNorm() * drive / ((32.0 + 23.0 * viscosity_ratio) * viscosity * twice_omega);
}

}  // namespace vehd
