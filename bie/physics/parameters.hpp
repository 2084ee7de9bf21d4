#pragma once

#include <optional>

#include "bie/physics/waveform.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Bending energy κ_B ∫ H² dA, force Eq. (2).
/// The usual Helfrich modulus is κ_c = κ_B/2; unit energy.
/// Source: paper Eq. (2)
struct BendingParameters {
  double modulus = 0.0;  ///< κ_B
  bool operator==(const BendingParameters&) const = default;
};

/// Thermal undulations too small to be resolved store area, which tension pulls out; in addition the lipids stretch.
struct Undulations {
  double thermal_energy = 0.0;                 ///< k_BT; 0: the membrane stretches and does not undulate
  double bending_rigidity = 0.0;               ///< κ_c = κ_B/2
  std::optional<double> stretching_modulus{};  ///< K_A; absent: lipids keep their area
  double rest_area = 0.0;                      ///< A_0, at zero tension; 0: see with_rest_area
  double reference_tension = 0.0;              ///< of the initial shape, unless A_0 is given
  bool operator==(const Undulations&) const = default;
};

/// Parameters that determine the velocity of one membrane, besides its shape and the forces.
struct FlowParameters {
  double viscosity = 1.0;        ///< μ_e, outside
  double viscosity_ratio = 1.0;  ///< μ_i/μ_e
  bool inextensible = true;
  std::optional<BendingParameters> bending{};
  std::optional<Undulations> undulations{};
};

/// Uniform field at infinity and the fluid outside the vesicles.
struct AppliedField {
  Vector3 field = Vector3::Zero();    ///< E_∞ when the waveform is 1
  double conductivity = 1.0;          ///< σ_e
  double permittivity = 1.0;          ///< ε_e
  Waveform waveform{};                ///< of the field
  bool displacement_current = false;  ///< in both fluids
  /// Frequency of a field that alternates so fast that only the mean of its force over a period matters; the waveform
  /// then applies to the amplitude.
  std::optional<double> averaged_frequency{};
  Vector3 direction = Vector3::Zero();  ///< of a zero field, of any length; zero if it has none

  /// A vector along the field, also if that is zero but has a direction.
  [[nodiscard]] const Vector3& along() const { return field.isZero(0.0) ? direction : field; }
};

/// The leaky dielectric inside one vesicle.
struct InnerDielectric {
  double conductivity = 1.0;        ///< σ_i
  double permittivity_ratio = 1.0;  ///< ε_i/ε_e
  bool operator==(const InnerDielectric&) const = default;
};

/// Leaky-dielectric bulk fluids on both sides of one membrane in a uniform applied field, Eq. (4).
/// Source: paper Eqs. (3), (4)
struct ElectricParameters {
  Vector3 field = Vector3::Zero();             ///< E_∞ when the waveform is 1
  double conductivity_in = 1.0;                ///< σ_i
  double conductivity_out = 1.0;               ///< σ_e
  double permittivity = 1.0;                   ///< ε_e
  double permittivity_ratio = 1.0;             ///< ε_i/ε_e
  Waveform waveform{};                         ///< of the field
  bool displacement_current = false;           ///< in both fluids
  std::optional<double> averaged_frequency{};  ///< see AppliedField
  double pump = 0.0;                           ///< factor of the pump current when its waveform is 1; 0 without a pump
  Waveform pump_waveform{};

  [[nodiscard]] double permittivity_in() const { return permittivity_ratio * permittivity; }

  /// These parameters with the field and the pump at one time, without waveforms.
  [[nodiscard]] ElectricParameters at(double time, Limit limit) const {
    ElectricParameters now = *this;
    now.field *= waveform.at(time, limit);
    now.waveform = {};
    now.pump *= pump_waveform.at(time, limit);
    now.pump_waveform = {};
    return now;
  }
};

/// Membrane as a leaky capacitor, Eq. (4e).
/// Per area of membrane.
/// Source: paper Eq. (4e)
struct ChargingParameters {
  double capacitance = 1.0;  ///< C_m
  double conductance = 0.0;  ///< G_m
  bool operator==(const ChargingParameters&) const = default;
};

}  // namespace vehd
