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

/// Errors of the fields that follow from the shape.
struct ShapeFlowErrors {
  MethodError velocity;  ///< v without the background flow
  MethodError tension;   ///< λ
};

/// All fields that a step solves for, from x, V_m and the parameters: q, f_E, f_b, λ and v of shape (33) in an oblique
/// field and a shear, with the steady V_m of the reference.
class ShapeFlowProblem {
 public:
  /// @param reference_order  degree of the reference solution, from which errors are taken
  /// @throws ConvergenceError
  explicit ShapeFlowProblem(int reference_order);

  /// Boundary-integral solution at one degree, tables included; the shape and V_m are truncated to it.
  /// @throws ConvergenceError
  [[nodiscard]] SolvedFields solve(int order) const;
  /// Errors over the membrane of the reference.
  [[nodiscard]] ShapeFlowErrors errors_of(const SolvedFields& solved) const;
  /// Writes the problem with the fields of the reference, a check_input.h5.
  /// @throws OutputError
  void write_input(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] MethodError error_of(const Matrix& found, const Matrix& exact, const Matrix& background) const;

  CheckProblem problem_;
  std::vector<CheckFields> reference_;
};

}  // namespace vehd
