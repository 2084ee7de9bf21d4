#include "bie/physics/sphere_in_ac_field.hpp"

#include <numbers>

#include "bie/physics/averaged_field.hpp"

namespace vehd {

SphereInAcField sphere_in_ac_field(const ElectricParameters& electric, const ChargingParameters& charging,
                                   double radius) {
  const ComplexConductivities k = complex_conductivities(electric);
  const std::complex<double> through = radius * membrane_admittance(charging, *electric.averaged_frequency);
  // Divided by K_e nowhere, so that the fluid outside may insulate.
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
