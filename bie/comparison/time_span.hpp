#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/comparison/frozen_state.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

/// Motion of one membrane from a snapshot to a later one of the same run, along which both methods advance V_m.
struct TimeSpan {
  double begin = 0.0, end = 0.0;
  std::string begin_text = "0";  ///< with its unit, as FrozenState::time_text
  Vector potential;              ///< V_m of the first snapshot, coefficients [n_coefficients]
  /// Times of the snapshots from begin to end; only the last one if the shape is at rest.
  std::vector<double> shape_times;
  std::vector<Matrix> positions;   ///< x at each of them, coefficients of one degree, [n_coefficients x 3]
  std::vector<Matrix> velocities;  ///< v of the membrane's material there; empty if the shape is at rest
  /// Evenly spaced between two discontinuities of the field, end points included: a discontinuity is there twice, with
  /// the field before it and the field after it.
  std::vector<double> field_times;
  Matrix field;                   ///< E_∞ at each of them, [n_times x 3]
  std::int64_t intervals = 0;     ///< number between two discontinuities
  std::int64_t fewest_steps = 0;  ///< of the finite elements between two discontinuities: at least four a period
  StepControl control;            ///< step control of the run
};

/// Largest number of steps of the finite elements between two discontinuities of the field. The first steps need the
/// field at thirds of a step.
constexpr std::int64_t most_span_steps = 512;
constexpr std::int64_t span_intervals = 3 * most_span_steps;

/// A membrane whose points and material move by less than this share of its radius is at rest.
constexpr double still_motion = 1e-6;

/// @param file  a run.h5
/// @param from  time of the first snapshot as text, see read_frozen_state
/// @param end   state of the last snapshot; its notes receive the time taken instead of `from`
/// @throws InputError if there is no such time before the end, no V_m, or a field that jumps or alternates too often
TimeSpan read_time_span(const std::filesystem::path& file, const std::string& from, FrozenState& end);

/// V_m at the end of a span by boundary integrals, with the shape held at that of the end: coefficients
/// [n_coefficients].
/// @param order  degree p
/// @param finer  with a quarter of the step of the run, or a tenth of its tolerance
/// @throws ConvergenceError
/// Accuracy: that of the steps of a run (bie/stepping/evolution.hpp)
Vector potential_in_time(const FrozenState& end, const TimeSpan& span, int order, bool finer);

/// Change of V_m at the end by finer steps, as above, if the run is repeated from the first snapshot at its degree:
/// V' + (x − x')·∇_γ V' − V, where primes mark finer steps, so that sliding of points along the membrane does not
/// count. Coefficients [n_coefficients]; empty if the shape is at rest.
/// @throws ConvergenceError if a step fails
Vector change_by_finer_motion(const FrozenState& end, const TimeSpan& span);

}  // namespace vehd
