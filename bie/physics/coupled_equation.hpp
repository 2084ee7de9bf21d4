#pragma once

#include <vector>

#include "bie/physics/coupled_electric.hpp"
#include "bie/physics/membrane_charging.hpp"

namespace vehd {

/// a of a V in one membrane's equation of charging.
struct Storage {
  double a = 0.0;    ///< C_m/dt + G_m, or its largest value
  Vector varying{};  ///< its values on the upsampled grid; empty where it is the same everywhere
};

/// The equations of charging of all membranes, each times κ/(a + κ/R) of its own:
///   ½ g_a + Σ_b η_b S′_ab[g_b] − Σ_b D′_ab[V_b] = E·n + what is given,   κ_b g_b = a_b V_b.
/// Source: paper Eqs. (14), (29), (30), without the inverse, the layers being those of all membranes
class CoupledEquation {
 public:
  /// All must outlive it.
  /// @throws InputError if a membrane that carries charge lies between fluids of which one insulates: g is not known
  ///     from V there
  CoupledEquation(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                  const std::vector<Storage>& storages);

  // Collective where membranes are those of several ranks, see Interaction; all ranks get the results of all.

  /// What V does on all membranes, coefficients of each, as all here.
  [[nodiscard]] std::vector<Vector> left_side(const std::vector<Vector>& potentials) const;
  /// Right sides of each membrane by itself and what given layers of charge do to all others; of both those of this
  /// rank count.
  /// @param charges  coefficients of J times the density of S′ that goes with the right side; an empty one is zero
  [[nodiscard]] std::vector<Vector> right_sides(const std::vector<Vector>& of_own,
                                                const std::vector<Vector>& charges) const;

  /// The equation of one membrane by itself; its layers are known on the rank of the membrane.
  [[nodiscard]] const ChargingEquation& own(std::size_t a) const { return own_[a]; }
  /// η/κ, and 0 without a.
  [[nodiscard]] double charge_of_current(std::size_t a) const { return charge_of_current_[a]; }
  /// Coefficients of J times a multiple of a field; empty where there is nothing.
  [[nodiscard]] Vector weighted(std::size_t a, double factor, const Vector& field) const;
  /// The same. @param values  on the upsampled grid
  [[nodiscard]] Vector weighted_values(std::size_t a, double factor, const Vector& values) const;

  /// V of all membranes by iterations that start from those given, with the inverse on the sphere of each membrane as
  /// preconditioner. The unknowns are V/R: what a field of one size makes of membranes of any size.
  /// @param potentials  first guesses on input, V on output
  [[nodiscard]] SolveReport solve(const std::vector<Vector>& rhs, double tolerance,
                                  std::vector<Vector>& potentials) const;

 private:
  const std::vector<ElectricMembrane>& membranes_;
  const Interaction& interaction_;
  const std::vector<Storage>& storages_;
  std::vector<std::size_t> owned_;  // membranes of this rank
  std::vector<ChargingEquation> own_;
  std::vector<double> charge_;             // η g over V
  std::vector<double> charge_of_current_;  // η g over a V
};

}  // namespace vehd
