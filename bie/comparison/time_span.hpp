#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/comparison/frozen_state.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

/// The way of one membrane from a snapshot to a later one of the same run, along which both sides advance V_m.
struct TimeSpan {
  double begin = 0.0, end = 0.0;
  Vector potential;  ///< V_m of the first snapshot, coefficients [n_coefficients]
  /// Times of the snapshots from begin to end; the last one alone if the shape stands still.
  std::vector<double> shape_times;
  std::vector<Matrix> positions;   ///< x at each of them, coefficients of one degree, [n_coefficients x 3]
  std::vector<Matrix> velocities;  ///< v of the membrane's material there; empty if the shape stands still
  /// Between two discontinuities of the field its times are evenly spaced, the ends among them: a discontinuity is
  /// there twice, with the field before it and the one after it.
  std::vector<double> field_times;
  Matrix field;                ///< E_∞ at each of them, [n_times x 3]
  std::int64_t intervals = 0;  ///< between two discontinuities
  StepControl control;         ///< of the steps of the run
};

/// Steps that the finite elements may take between two discontinuities of the field at most. Their start needs the
/// field at thirds of a step.
constexpr std::int64_t most_span_steps = 512;
constexpr std::int64_t span_intervals = 3 * most_span_steps;

/// A shape whose points move by less than this share of its radius stands still.
constexpr double still_motion = 1e-6;

/// @param file  a run.h5
/// @param from  time of the first snapshot as people write it, see read_frozen_state
/// @param end   data of the last one
/// @throws InputError if there is no such time before the end, or no V_m, or a field that jumps too often
TimeSpan read_time_span(const std::filesystem::path& file, const std::string& from, const FrozenState& end);

/// V_m at the end of a span by boundary integrals, on the shape of the end, held still: coefficients
/// [n_coefficients].
/// @param order  degree p
/// @param finer  with a quarter of the step of the run, or a tenth of its tolerance
/// @throws ConvergenceError
/// Accuracy: that of the steps of a run (bie/stepping/evolution.hpp)
Vector potential_in_time(const FrozenState& end, const TimeSpan& span, int order, bool finer);

/// Change of V_m at the end by finer steps, as above, when the run is repeated from the first snapshot at its degree:
/// V' + (x − x')·∇_γ V' − V, primed with finer steps, so that points that slide along the membrane do not count.
/// Coefficients [n_coefficients]; empty if the shape stands still.
/// @throws ConvergenceError if a step fails
Vector change_by_finer_motion(const FrozenState& end, const TimeSpan& span);

}  // namespace vehd
