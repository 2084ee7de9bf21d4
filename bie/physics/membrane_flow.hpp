#pragma once

#include <memory>
#include <vector>

#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/interaction.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

class RecycledGcr;

/// A membrane in a flow. Of several the viscosity outside is that of all.
struct FlowMembrane {
  FlowParameters parameters;
  const Membrane& membrane;
};

/// Which layers of this membrane the flow about the others needs.
PairSelection flow_pair_selection(const FlowParameters& parameters);

/// Velocity map of frozen membranes,
///   (1 + Λ_a)/2 v_a − (1 − Λ_a) D_aa[v_a] − Σ_{b≠a} (1 − Λ_b) D_ab[v_b] = v_∞ + Σ_b S_ab[f_b]/μ,
/// Λ the ratios of the viscosities. Where all are 1 it is explicit; elsewhere the double layers between the membranes
/// are iterated with each membrane's own inverse as preconditioner, and directions that one application has found serve
/// the next.
///
/// Accuracy: a flow common to fluids of other viscosities to 1e-7 at p = 14, spheres along their line of centres to
/// 1e-8 (tests/stepping/solve/tension_solve_test.cpp)
/// Source: paper Eq. (5); Pozrikidis 1992
class MembraneFlow {
 public:
  /// Membranes and interaction must outlive it.
  MembraneFlow(const std::vector<FlowMembrane>& membranes, const Interaction& interaction);
  ~MembraneFlow();
  MembraneFlow(MembraneFlow&&) noexcept;

  /// Which membranes are whose: of forces and velocities those of this rank count, see Interaction.
  [[nodiscard]] const Partition& partition() const { return interaction_.partition(); }
  /// Which membranes are images of others.
  [[nodiscard]] const Exchange& exchange() const { return interaction_.exchange(); }
  /// Is there a membrane that moves another one or, by way of a wall, itself?
  [[nodiscard]] bool interacts() const { return !interaction_.is_empty(); }
  /// Velocities of the membranes under forces on the fluid, coefficients.
  /// @param weighted    of J f, [n_coefficients x 3]; empty ones are zero
  /// @param background  v_∞ on each, or nothing
  /// @throws ConvergenceError if the double layers do not converge
  [[nodiscard]] std::vector<Matrix> velocities(const std::vector<Matrix>& weighted,
                                               const std::vector<Matrix>& background = {});

 private:
  const std::vector<FlowMembrane>& membranes_;
  const Interaction& interaction_;
  bool contrast_;
  StackedEntries stacked_;
  std::unique_ptr<RecycledGcr> solver_;  // where there is a contrast
};

}  // namespace vehd
