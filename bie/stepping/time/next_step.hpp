#pragma once

#include <optional>
#include <vector>

#include "bie/stepping/state/state.hpp"
#include "bie/stepping/time/collocation.hpp"

namespace vehd {

/// Sweeps that tell how they contract: one tells nothing.
int fewest_sweeps(int order);

/// dt times this would leave just the error that is allowed, of one that falls like dt^power.
double size_factor(double error, double allowed, int power);

/// Errors of a step that decide about the next one, each as many times as it counts.
struct StepErrors {
  double allowed = 0.0;
  std::vector<double> after;        ///< sweep 1, 2, … order − 1, whether it was made or not
  double of_explicit_step = 0.0;    ///< of y_0 + dt F_0 at the end
  std::optional<double> of_past{};  ///< of the past continued to the end; nothing where it is not known
};

/// What the next step, or the next try of this one, is to be.
struct NextStep {
  double factor = 1.0;  ///< its size over that of this one
  Beginning beginning = Beginning::afresh;
  /// What is known of steps that begin afresh, see Past.
  double afresh_dt = 0.0;
  Vector afresh_errors;
};

/// The size and the beginning that get on at the least cost, (1 + sweeps × nodes)/dt. After sweep j what is left falls
/// like dt^(j+1) at least where a step begins afresh, and its first-order steps cost about as much as an evaluation;
/// with the past of M nodes continued like dt^(M+1+j). Of the way that was not taken this time the errors are those of
/// the other one times what both begin with, or those of the last step that began afresh, whose sweeps contracted like
/// its size. The past has to be cheaper by a margin: steps that begin afresh may grow faster.
/// @param past      of the state that the step started from
/// @param dt        of the step
/// @param n_nodes   of its rule
/// @param accepted  whether the step was good enough; after one that was not an untried beginning is not tried
NextStep next_step(const StepErrors& errors, const Past& past, double dt, int n_nodes, Beginning beginning,
                   bool accepted);

}  // namespace vehd
