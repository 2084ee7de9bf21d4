#pragma once

#include <memory>
#include <variant>

#include "fem_check/discretisation.hpp"
#include "fem_check/per_vesicle.hpp"
#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// [[φ]] = V_m is given at every point of γ.
struct PrescribedJump {
  ScalarOnSurface potential_jump;
};

/// Steady membrane, −σ_i ∂φ_i/∂n = G_m V_m. If G_m = 0, the mean of V_m is undetermined; `mean` prescribes it, since
/// charging conserves it. Otherwise `mean` is not used.
struct SteadyMembrane {
  PerVesicle<double> conductance = 0.0;
  PerVesicle<double> mean = 0.0;
};

/// Given free charge of the inner face, −ε_i ∂φ_i/∂n = C_m V_m − q_i: the conductivities of the problem are then
/// permittivities, and its current jump is q_i + q_e.
struct ChargedMembrane {
  PerVesicle<double> capacitance = 1.0;
  ScalarOnSurface inner_charge;  ///< q_i
};

/// Backward Euler steps of C_m dV_m/dt + G_m V_m = −σ_i ∂φ_i/∂n.
struct ChargingMembrane {
  PerVesicle<double> capacitance = 1.0;
  PerVesicle<double> conductance = 0.0;
  double time_step = 0.1;
  int steps = 1;
  ScalarOnSurface initial;  ///< V_m before the first step
};

/// Condition at the membrane.
using MembraneCondition = std::variant<PrescribedJump, SteadyMembrane, ChargedMembrane, ChargingMembrane>;

/// Condition at the outer sphere for the disturbance ψ = φ + E_∞·x.
struct OuterCondition {
  /// Which condition holds.
  enum class Kind {
    exterior_field,  ///< ∂ψ/∂r of the exterior field: exact for harmonics up to the exterior degree
    dirichlet,       ///< ψ given
    neumann          ///< ∂ψ/∂r given
  };
  Kind kind = Kind::exterior_field;
  std::function<double(const Vector3&)> value;  ///< absent: zero
};

/// Condition at the wall, if the mesh has one: no current through it, or ψ = 0. In the latter case φ is constant on it
/// if E_∞ is normal to it.
enum class WallField { insulating, electrode };

/// Δφ = 0 on both sides of γ, which consists of all membranes of the mesh; φ → −E_∞·x far away.
struct PotentialProblem {
  Vector3 field = Vector3::Zero();  ///< E_∞
  PerVesicle<double> conductivity_in = 1.0;
  double conductivity_out = 1.0;
  PerVesicle<double> permittivity_in = 1.0;
  double permittivity_out = 1.0;
  MembraneCondition membrane = SteadyMembrane{};
  ScalarOnSurface current_jump;  ///< [[σ ∂φ/∂n]]; absent: zero, the current is continuous
  OuterCondition outer;
  WallField wall = WallField::insulating;
  double tolerance = 3e-12;  ///< of the linear solver, relative
  int exterior_degree = usual_exterior_degree;
};

/// Traces on γ that the boundary integrals provide too. E = −∇φ.
struct PotentialTraces {
  Vector transmembrane_potential;  ///< V_m
  Vector charge;                   ///< q = ∂φ_i/∂n − ∂φ_e/∂n, by variational recovery
  Vector flux_in;                  ///< ∂φ_i/∂n, by variational recovery
  Vector charge_from_gradient;     ///< from the interior gradient and the continuity of current
  Vector flux_in_from_gradient;    ///< n·∇φ_i
  Vectors force;  ///< f_E = [[n·Σ]], Σ = ε (E ⊗ E − ½|E|² I): tangential gradients, recovered fluxes
};

/// Solution of a PotentialProblem. Immutable.
class PotentialSolution {
 public:
  struct Data;
  explicit PotentialSolution(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  /// Traces at points of γ.
  [[nodiscard]] PotentialTraces on_surface(const SurfacePoints& points) const;
  /// φ at points of the volume, [points.size()].
  [[nodiscard]] Vector potential(const VolumePoints& points) const;
  /// Cost of the solution.
  [[nodiscard]] const Cost& cost() const;
  /// Data for solvers that use it as initial guess.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Solves the weak form of the problem.
/// @param start  initial guess, on the same mesh with elements of any degree; null: zero
/// @throws std::invalid_argument if a conductivity, conductance, capacitance or time step is out of range
/// @throws SolveError if the linear solver does not converge
/// Accuracy: φ and V_m of order degree + 1, fluxes of order degree (tests/fem_check/convergence_test.cpp)
/// Source: paper Eqs. (4), (30); weak form in docs/weak_forms.md
PotentialSolution solve_potential(const Discretisation& discretisation, const PotentialProblem& problem,
                                  const PotentialSolution* start = nullptr);

/// Implicit steps of one size for a charging membrane, for any time integrator composed of such steps; the operators
/// are set up once. V_m is represented by its values at rule().
class ChargingSteps {
 public:
  /// @param problem  with a ChargingMembrane, whose initial V_m and number of steps are not used
  /// @throws std::invalid_argument as solve_potential
  ChargingSteps(const Discretisation& discretisation, const PotentialProblem& problem);
  ~ChargingSteps();
  ChargingSteps(ChargingSteps&&) noexcept;
  ChargingSteps& operator=(ChargingSteps&&) noexcept;

  /// V_m at the points of the rule, [rule().size()], with C_m (V_m − from)/τ + G_m V_m = −σ_i ∂φ_i/∂n, τ the time step
  /// of the problem.
  /// @param from   values at the points of the rule, [rule().size()]
  /// @param field  E_∞ at the end of the step
  /// @throws SolveError if the linear solver does not converge, std::invalid_argument for another number of values
  Vector step(const Vector& from, const Vector3& field);
  /// Gauss points of γ.
  [[nodiscard]] const SurfacePoints& rule() const;
  /// Trace function of values at the rule, [rule().size()], evaluated at other points of γ, [points.size()].
  [[nodiscard]] Vector at(const SurfacePoints& points, const Vector& values) const;
  /// Accumulated cost of the steps.
  [[nodiscard]] const Cost& cost() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vehd::fem_check
