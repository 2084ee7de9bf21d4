#pragma once

#include <vector>

#include "bie/fit/least_squares.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// A combination of parameters that the data do not determine.
struct Combination {
  Vector direction;          ///< unit vector in p along which the model hardly changes
  double least_error = 0.0;  ///< its standard error is at least this
};

/// Errors and correlations of parameters, by the linearised model.
struct Statistics {
  /// (JᵀJ)⁻¹ among the combinations that are determined.
  Matrix covariance;
  Vector errors;       ///< standard errors; infinite of a parameter that is not determined
  Matrix correlation;  ///< NaN where a parameter is not determined
  std::vector<Combination> undetermined;
};

/// Looks for undetermined combinations: a run is wrong by η deviations (`run_error`), so central differences with the
/// steps h_k change |Jv| along a unit vector v by up to η √(N Σ (v_k/h_k)²/2). An eigenvector v of JᵀJ whose |Jv| is
/// below that is differentiated once more, along itself and with a step H as long as the intervals allow, 0.5 at most,
/// and if that finds a change, with H/2 as well (Richardson). It is undetermined if |Jv| is then below the error of
/// this difference, η √(N/2)/H or 2.7 times that. Its standard error 1/|Jv| is thus at least 0.37 √(2/N) H/η: 0.5, for
/// data that have run_error_in_deviations.
/// @param minimum  its jacobian is improved in these directions
std::vector<Combination> undetermined_combinations(const LeastSquares& problem, Minimum& minimum);

/// A parameter is not determined if an undetermined combination that is moved by its least error moves the parameter by
/// more than the standard error that the other combinations leave it.
/// Accuracy: rounding, of a linear model (tests/fit/statistics_test.cpp)
Statistics statistics_of(const Matrix& jacobian, std::vector<Combination> undetermined);

}  // namespace vehd
