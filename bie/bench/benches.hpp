#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bie/bench/result.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/scene/scene.hpp"
#include "bie/stepping/time/events.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// Runs the scenes as they are, files and pictures included: their final values and cost. Pictures go to the
/// folder as SCENE_shapes.png and SCENE_history.png; nothing else is left of the runs.
/// @throws ConvergenceError where a run does not reach its end
BenchResult bench_scenes(const std::vector<std::filesystem::path>& scenes, const std::filesystem::path& pictures,
                         BenchObserver& observer);

/// The scene files of a folder by name, or the one scene file that is given.
/// @throws InputError if there are none
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& place);

/// Errors in space against the degree and the seconds: q and f_E of Example 1, and the velocity of a 2:1 prolate pulled
/// along and across its axis, whose exact velocity is constant, with the poles of the grid off the axis. All errors are
/// relative maxima over the nodes. The table `equal` has the lowest degree, seconds and memory at which f_E and the
/// velocity are right to 1e-4, 1e-7 and 1e-10, empty where twice the largest of the asked degrees, 64 at most, is not
/// enough.
/// @throws ConvergenceError
BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer);

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

/// Seconds of the first step of the scene, and of each part of a steady one with its memory, against the degree; the
/// exponents with which they grow, and the fraction of the machine's measured peak at which their counted operations
/// run, see StepTimer.
/// @param orders  ascending
/// @throws InputError for a scene without dt
BenchResult bench_parts(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

/// 1, 2, 4, … and the number of hardware threads.
std::vector<int> thread_counts();

/// Seconds of each part of a step of the scene against the number of threads, speed-up and efficiency against the first
/// count, and how far the state after the same steps is from the one that the first count reaches. Repeats go round
/// the counts, so that all see the same load of the machine.
/// @throws InputError for a scene without dt
BenchResult bench_threads(Scene scene, const std::vector<int>& counts, int repeats, BenchObserver& observer);

/// Seconds of a step of the scene at each degree with the symmetry that it has and with the full solver, and how far
/// the states are from each other after the same steps. Both take their steps in turn, so that they see the same load
/// of the machine.
/// @throws InputError for a scene without dt or without symmetry
BenchResult bench_symmetry(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

/// How much is measured.
struct MethodsTask {
  bool quick = false;  ///< two levels of each
  int repeats = 3;
};

/// Boundary integrals against finite elements, both on one thread: the point sources of Example 1 on shape (33), whose
/// solution is known, and as a further table all that a step solves for, ShapeFlowProblem.
/// @param folder  for files that are gone at the end
/// @throws InputError if the finite-element program is not there
BenchResult bench_methods(const MethodsTask& task, const std::filesystem::path& folder, BenchObserver& observer);

/// Which hard cases are run, and where their files go.
struct StabilityTask {
  std::vector<std::filesystem::path> scenes;  ///< with their criteria, see StabilityCase
  /// Each run has a folder of its own below `runs`, always a fresh one; its first and last shape go to shapes/NAME.png.
  BenchOutput output;
  bool brief = false;  ///< the short form of every case
};

/// Outcome of the cases.
struct StabilityOutcome {
  BenchResult result;
  int n_failed = 0;
};

/// Draws the shapes of one case, small, in a folder.
/// @param paths  of its run, in a folder with the name of the case
/// @return the picture
/// @throws InputError if the run cannot be read or gnuplot is missing
std::filesystem::path draw_case(const RunPaths& paths, const std::filesystem::path& folder);

/// Runs every case as `vehd run` would and prints, for each, the criterion that came closest to its bound. Further
/// tables are for the pages: "pictures" with the shapes, which they look for in images/hard_cases, "families" with one
/// row for each family, and "faults" with the cases whose verdict names a fault.
/// @throws InputError for a scene or criterion that cannot be read, Interrupted
StabilityOutcome bench_stability(const StabilityTask& task, Interruption& interruption, BenchObserver& observer);

/// Which benches are run, and which pages they renew.
struct AllTask {
  std::filesystem::path docs;  ///< folder with the pages, images/ and scenes/
  BenchOutput output;
  bool quick = false;               ///< few degrees and tolerances, one repeat: shows that it works, measures little
  std::vector<std::string> only{};  ///< names of benches; empty: all
};

/// In the order in which they are run.
std::vector<std::string> names_of_benches();

/// Runs every scene, every bench and the commands by which pages make pictures of their own, and renews the pictures
/// and the tables of the pages from their results. Benches of the finite elements are left out where these are not
/// built, and said.
/// @return name and machine of every bench
/// @throws InputError if there are no pages
nlohmann::ordered_json bench_all(const AllTask& task, BenchObserver& observer);

}  // namespace vehd
