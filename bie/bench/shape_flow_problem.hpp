#pragma once

#include <filesystem>
#include <vector>

#include "bie/comparison/check_fields.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Relative errors of a field on γ.
struct MethodError {
  double l2 = 0.0, max = 0.0;
};

/// Errors of the fields from the shape.
struct ShapeFlowErrors {
  MethodError velocity;  ///< v without the background flow
  MethodError tension;   ///< λ
};

/// Everything that a step solves for, from x, V_m and the physics: q, f_E, f_b, λ and v of shape (33) in an oblique
/// field and a shear, with the steady V_m of the reference.
class ShapeFlowProblem {
 public:
  /// @param reference_order  degree whose solution counts as exact
  /// @throws ConvergenceError
  explicit ShapeFlowProblem(int reference_order);

  /// Boundary integrals of one degree, from the tables of the degree on; the shape and V_m are cut to it.
  /// @throws ConvergenceError
  [[nodiscard]] SolvedFields solve(int order) const;
  /// Over the reference's membrane.
  [[nodiscard]] ShapeFlowErrors errors_of(const SolvedFields& solved) const;
  /// The problem with the reference's numbers, a check_input.h5.
  /// @throws OutputError
  void write_input(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] MethodError error_of(const Matrix& found, const Matrix& exact, const Matrix& background) const;

  CheckProblem problem_;
  std::vector<CheckFields> reference_;
};

}  // namespace vehd
