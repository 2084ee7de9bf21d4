#pragma once

#include <vector>

#include "bie/physics/effects/poration.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/interaction.hpp"
#include "bie/support/complex_columns.hpp"

namespace vehd {

/// A charging membrane in a field.
struct ChargingMembrane {
  ElectricMembrane in_field;
  ChargingParameters charging;
  const PorationReaction* reaction = nullptr;  ///< null: the membrane does not porate
};

/// C_m on the upsampled grid, [n_points].
Vector capacitance_of(const ChargingParameters& charging, const Membrane& membrane);
/// G_m on the upsampled grid, [n_points].
Vector conductance_of(const ChargingParameters& charging, const Membrane& membrane);

/// The current per area through a membrane, outwards and linear in V at every point: G V + J, values on the upsampled
/// grid, [n_points].
struct MembraneCurrent {
  Vector conductance, constant;
};
/// The current (G_m + g(s)) V + J_p of a membrane.
/// @param poration  s of a membrane that porates, coefficients [n_coefficients]; empty: the intact membrane
MembraneCurrent membrane_current(const ChargingMembrane& of, const Vector& poration = {});
/// The current at a given V, values on the upsampled grid, [n_points].
/// @param potential  V, coefficients [n_coefficients]
Vector current_through(const Membrane& membrane, const MembraneCurrent& current, const Vector& potential);

/// The fields at the faces of one membrane as functions of V: E_i = (aV − s_i)/k_i inside and E_e = (aV + s_e)/k_e
/// outside, with E_k = −∂φ_k/∂n. Values on the upsampled grid, [n_points]; complex for amplitudes.
template <typename Scalar>
struct CurrentLaw {
  FieldOf<Scalar> a;               ///< ≥ 0 if real
  Scalar k_in = 1.0, k_out = 1.0;  ///< of the fluids, from σ, ε or both; not both zero
  FieldOf<Scalar> s_in, s_out;

  /// w_k = κ/k_k.
  [[nodiscard]] Scalar share_in() const { return k_out / (k_in + k_out); }
  [[nodiscard]] Scalar share_out() const { return k_in / (k_in + k_out); }
  /// (k_i − k_e)/(k_i + k_e), as η of Eq. (11).
  [[nodiscard]] Scalar contrast() const { return share_out() - share_in(); }
  /// κ = k_i k_e/(k_i + k_e), as the prefactor of Eq. (14).
  [[nodiscard]] Scalar series() const { return k_in * share_in(); }
};

/// E_i and E_e, values on the upsampled grid, [n_points].
template <typename Scalar>
struct FieldsAtFaces {
  FieldOf<Scalar> in, out;
};
/// Both fields for a given V.
/// @param potential  V, coefficients [n_coefficients]
template <typename Scalar>
FieldsAtFaces<Scalar> fields_of(const CurrentLaw<Scalar>& law, const Membrane& membrane,
                                const FieldOf<Scalar>& potential);

/// Solves for V of all membranes, with both fields functions of V,
///   ½(E_i + E_e)_a + Σ_b S′_ab[(E_e − E_i)_b] − Σ_b D′_ab[V_b] = E·n on every membrane a,
/// multiplied by κ = k_i k_e/(k_i + k_e), so that either k may be zero. For one membrane and η = (k_i − k_e)/(k_i +
/// k_e) this is
///   (½ + ηS′)aV − κD′[V] = κE·n + ½(w_i s_i − w_e s_e) − S′[w_i s_i + w_e s_e],  w_k = κ/k_k.
/// No net current leaves a membrane: the equation of degree 0 is ∫(aV − s_i) dA = 0, or zero mean of V if a = 0. The
/// unknowns are V/R, which are of equal size on membranes of any size in one field. Each equation is divided by |mean
/// of a| + |κ|/R and preconditioned with its inverse on a sphere.
///
/// Collective if the membranes belong to several ranks, see Interaction; all ranks receive all potentials.
/// @param potentials   coefficients [n_coefficients]; first guesses on input, V of each on output
/// @param tolerance    of the preconditioned residual, relative
/// @throws InputError  if one of several membranes has a ≠ 0 and a zero k: V does not determine its charge
/// Accuracy: that of the layers (tests/physics/charging_test.cpp, tests/physics/charge_density_test.cpp)
/// Source: paper Eqs. (12)–(14), (29), (30), without the inverse; docs/theory/electric.md
template <typename Scalar>
SolveReport solve_laws(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                       const std::vector<CurrentLaw<Scalar>>& laws, double tolerance,
                       std::vector<FieldOf<Scalar>>& potentials);

/// Traces for the V of solve_laws. The mean of both fields is evaluated from the layers, which smooth, because aV − s_i
/// would amplify truncation errors; the jump of the fields follows from k_e E_e − k_i E_i = s_i + s_e. Neither k may be
/// zero.
/// @return  traces of each membrane, empty for those of other ranks
/// Source: paper Eqs. (7), (11), (13)
template <typename Scalar>
std::vector<TracesOf<Scalar>> traces_of_laws(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction,
                                             const std::vector<CurrentLaw<Scalar>>& laws,
                                             const std::vector<FieldOf<Scalar>>& potentials);

}  // namespace vehd
