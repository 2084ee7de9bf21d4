#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bie/fit/fit_file.hpp"
#include "bie/fit/least_squares.hpp"
#include "bie/fit/model_runs.hpp"
#include "bie/fit/statistics.hpp"

namespace vehd {

/// Values of the free keys that fit the data best, and their errors.
struct FitResult {
  Minimum minimum;
  Statistics statistics;
  std::vector<double> values;  ///< of the keys, each in its unit
  /// Verdicts of the runs with these values, one list for each experiment.
  std::vector<std::vector<std::string>> verdicts;

  /// Settings "table.key=value" of these values.
  [[nodiscard]] std::vector<std::string> settings(const FitFile& fit) const;
};

/// Data, deviations, intervals and start of a fit; the model is left to the caller.
LeastSquares least_squares_of(const FitFile& fit);

/// Fits the free keys of all experiments together, with runs as the model.
/// @param report_progress  called after each evaluation of the model, with χ² so far; may be empty
/// @throws InputError if the model has no value at the start or on either side of a point
/// @throws Interrupted on a signal (finished runs are kept), OutputError
FitResult fit_keys(const FitFile& fit, const ModelRuns& runs,
                   std::function<void(int n_evaluations, double chi2)> report_progress = {});

}  // namespace vehd
