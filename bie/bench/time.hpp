#pragma once

#include <vector>

#include "bie/bench/result.hpp"
#include "bie/scene/scene.hpp"
#include "bie/stepping/time/snapshot_times.hpp"

namespace vehd {

/// Which orders and step sizes are measured.
struct TimeTask {
  Scene scene;
  double at = 0.0;                   ///< time at which the history quantities are compared
  std::vector<double> steps{};       ///< fixed step sizes, each half of the one before
  std::vector<int> time_orders{};    ///< integrators that take them; empty: the scene's own
  std::vector<double> tolerances{};  ///< falling
  SnapshotTimes snapshots{};         ///< with a tolerance they are compared as well, and the start
  int repeats = 1;
};

/// Error of the history quantities against the step size, the steps and the seconds, for each integrator and for a
/// tolerance; with fixed steps also the values, the order observed from the last three and the limit that follows.
/// The reference is the last tolerance; without any, a run of the highest order with half the smallest step where
/// orders above 2 are compared, otherwise with the middle one. Errors are the largest of all rows and vesicles, over
/// the largest value of the quantity in them; those of angles in radians. Values are of the first
/// vesicle. Beside a tolerance, whose degree is its own, errors of fixed steps are also taken from that run of their
/// own degree: the errors of the steps alone. A last table has the cost of one more digit with each integrator that
/// three errors are known of.
/// @throws InputError, ConvergenceError
BenchResult bench_time(const TimeTask& task, BenchObserver& observer);

}  // namespace vehd
