#pragma once

#include <vector>

#include "bie/fit/least_squares.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// A combination of parameters that the data do not determine.
struct Combination {
  Vector direction;          ///< unit vector in p, [n_parameters], along which the model hardly changes
  double least_error = 0.0;  ///< its standard error is at least this

  /// Those with a share of at least 0.05, largest first.
  [[nodiscard]] std::vector<Index> parameters() const;
};

/// Errors and correlations of parameters, from the linearised model.
struct Statistics {
  Matrix covariance;   ///< (JᵀJ)⁻¹ in the space of the determined combinations, [n_parameters x n_parameters]
  Vector errors;       ///< standard errors, [n_parameters]; infinite for a parameter that is not determined
  Matrix correlation;  ///< [n_parameters x n_parameters]; NaN where a parameter is not determined
  std::vector<Combination> undetermined;
};

/// Finds undetermined combinations. A run has an error of η deviations (`run_error`), so central differences with the
/// steps h_k change |Jv| along a unit vector v by up to η √(N Σ (v_k/h_k)²/2). An eigenvector v of JᵀJ with |Jv| below
/// that is differentiated again, along v, with a step H as long as the intervals allow, at most 0.5. If this finds a
/// change, H/2 is used as well (Richardson). v is undetermined if |Jv| is then below η √(N/2)/H, the error of this
/// difference, or 2.7 times that. Its standard error 1/|Jv| is thus at least 0.37 √(2/N) H/η: 0.5 for H = 0.5 and a
/// `run_error` of run_error_in_deviations. If the intervals allow no longer step than those of the Jacobian, v remains
/// undetermined.
/// @param minimum  its jacobian is improved in these directions
std::vector<Combination> undetermined_combinations(const LeastSquares& problem, Minimum& minimum);

/// Covariance, errors and correlations. A parameter is not determined if it is one of an undetermined combination's, or
/// if that, moved by its least error, moves it by more than its standard error from the other combinations.
/// @param jacobian  J = ∂m_i/∂p_k / s_i, [n_data x n_parameters]
/// @param at_end    parameters at an end of their intervals, which are not determined either
/// Accuracy: rounding, for a linear model (tests/fit/statistics_test.cpp)
Statistics statistics_of(const Matrix& jacobian, std::vector<Combination> undetermined,
                         const std::vector<Index>& at_end = {});

}  // namespace vehd
