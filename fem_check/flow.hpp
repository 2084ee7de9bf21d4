#pragma once

#include <memory>

#include "fem_check/discretisation.hpp"
#include "fem_check/per_vesicle.hpp"
#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// Condition at the wall, if the mesh has one: the disturbance v − A x vanishes, or it has no normal component and no
/// tangential stress.
enum class WallFlow { no_slip, stress_free };

/// Stokes flow −∇p + μΔv = 0 on both sides of γ, which consists of all membranes of the mesh; v continuous, v → A x far
/// away. Velocities have the degree of the discretisation, pressures one degree less; the pressure can jump across γ.
struct FlowProblem {
  VectorOnSurface force;               ///< f, force per area of the membrane on the fluid: f = [[T n]]
  Matrix3 gradient = Matrix3::Zero();  ///< A, v_i = A_ij x_j, trace-free
  double dilation = 0.0;               ///< ∇_γ·v on γ, if a tension prescribes it
  PerVesicle<double> viscosity_in = 1.0;
  double viscosity_out = 1.0;
  WallFlow wall = WallFlow::no_slip;
  double tolerance = 1e-10;  ///< of the linear solver, relative
  int exterior_degree = usual_exterior_degree;
};

/// Operators and preconditioners of flows with given viscosities and a given wall condition on one discretisation: set
/// up once for any number of problems. Immutable.
class FlowOperators {
 public:
  struct Data;
  /// @throws std::invalid_argument for a degree below 2 or a viscosity that is not positive
  FlowOperators(const Discretisation& discretisation, const PerVesicle<double>& viscosity_in, double viscosity_out,
                WallFlow wall = WallFlow::no_slip);

  /// Data for the solvers.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// Velocity and its divergence on the membrane.
struct FlowTraces {
  Vectors velocity;   ///< v on γ
  Vector divergence;  ///< ∇_γ·v: zero if the membrane is inextensible
};

/// Solution of a FlowProblem. Immutable.
class FlowSolution {
 public:
  struct Data;
  explicit FlowSolution(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  /// Traces at points of γ.
  [[nodiscard]] FlowTraces on_surface(const SurfacePoints& points) const;
  /// v at points of the volume, [3 x points.size()].
  [[nodiscard]] Vectors velocity(const VolumePoints& points) const;
  /// Pressure at points of the volume, [points.size()], zero far away.
  [[nodiscard]] Vector pressure(const VolumePoints& points) const;
  /// Cost of the solution.
  [[nodiscard]] const Cost& cost() const;
  /// Data for solvers that use it as initial guess.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// @param start  initial guess, on the same mesh with elements of any degree; null: zero
/// @throws std::invalid_argument for a degree below 2, a viscosity that is not positive or a gradient with a trace
/// @throws SolveError if the linear solver does not converge
/// Accuracy: converges with the degree of the elements (tests/fem_check/exact_flow_test.cpp)
/// Source: weak form in docs/weak_forms.md; Taylor–Hood elements
FlowSolution solve_flow(const Discretisation& discretisation, const FlowProblem& problem,
                        const FlowSolution* start = nullptr);
/// Solves with given operators.
/// @throws std::invalid_argument also if the problem has other viscosities or another wall condition
FlowSolution solve_flow(const FlowOperators& operators, const FlowProblem& problem,
                        const FlowSolution* start = nullptr);

}  // namespace vehd::fem_check
