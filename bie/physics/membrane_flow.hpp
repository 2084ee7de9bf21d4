#pragma once

#include <memory>
#include <vector>

#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/interaction.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

class RecycledGcr;

/// A membrane in a flow. Several membranes have the same viscosity outside.
struct FlowMembrane {
  FlowParameters parameters;
  const Membrane& membrane;
};

/// Layers of this membrane that the flow about the others requires.
PairSelection flow_pair_selection(const FlowParameters& parameters);

/// Velocity map of frozen membranes,
///   (1 + Λ_a)/2 v_a − (1 − Λ_a) D_aa[v_a] − Σ_{b≠a} (1 − Λ_b) D_ab[v_b] = v_∞ + Σ_b S_ab[f_b]/μ,
/// Λ the ratios of the viscosities. If all are 1 the map is explicit. Otherwise the double layers between the membranes
/// are solved iteratively, with each membrane's own inverse as preconditioner; search directions of one application are
/// reused in the next.
///
/// Accuracy: a flow common to fluids of different viscosities to 1e-7 at p = 14, spheres along their line of centres to
/// 1e-8 (tests/stepping/solve/tension_solve_test.cpp)
/// Source: paper Eq. (5); Pozrikidis 1992
class MembraneFlow {
 public:
  /// Membranes and interaction must outlive it.
  MembraneFlow(const std::vector<FlowMembrane>& membranes, const Interaction& interaction);
  ~MembraneFlow();
  MembraneFlow(MembraneFlow&&) noexcept;

  /// Assignment of membranes to ranks: forces and velocities are those of this rank, see Interaction.
  [[nodiscard]] const Partition& partition() const { return interaction_.partition(); }
  /// Which membranes are images of others.
  [[nodiscard]] const Exchange& exchange() const { return interaction_.exchange(); }
  /// Does any membrane move another one or, through a wall, itself?
  [[nodiscard]] bool interacts() const { return !interaction_.is_empty(); }
  /// Velocities of the membranes under forces on the fluid, coefficients.
  /// @param weighted    of J f, [n_coefficients x 3]; empty ones are zero
  /// @param background  v_∞ on each, or empty
  /// @throws ConvergenceError if the double layers do not converge
  [[nodiscard]] std::vector<Matrix> velocities(const std::vector<Matrix>& weighted,
                                               const std::vector<Matrix>& background = {});

 private:
  const std::vector<FlowMembrane>& membranes_;
  const Interaction& interaction_;
  bool contrast_;
  StackedEntries stacked_;
  std::unique_ptr<RecycledGcr> solver_;  // null without a contrast
};

}  // namespace vehd
