#pragma once

#include "fem_check/potential.hpp"
#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// The unknown is v = φ + E_∞·x_0 − c inside and the disturbance ψ = φ + E_∞·x outside, with x_0 the centre of the
/// outer sphere and c a constant of each vesicle close to the mean of φ inside. The nearly constant field inside a good
/// conductor, and the far field, are then not differences of large discrete values. V_m = v − ψ + E_∞·(x − x_0) + c.
struct PotentialSolution::Data {
  std::shared_ptr<const Space> space;
  PotentialProblem problem;
  dealii::Vector<double> nodal;
  std::vector<double> constant;  ///< c
  Vector voltage;                ///< V_m at the nodes of γ, L2 projection
  Vector current;                ///< σ_i ∂φ_i/∂n at the nodes of γ, L2 projection of the residual of one side
  Cost cost;

  /// V_m − (v − ψ) at points of γ, [points.size()].
  [[nodiscard]] Vector background(const SurfacePoints& points) const {
    Vector result = (points.position.colwise() - space->centre).transpose() * problem.field;
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] += constant[points.vesicle[i]];
    return result;
  }
};

/// V_m from the unknowns at points of γ, [points.size()].
Vector membrane_voltage(const PotentialSolution::Data& data, const SurfacePoints& points);

}  // namespace vehd::fem_check
