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

/// Runs the scenes unchanged, files and pictures included: their final values and cost. Pictures go to the folder as
/// SCENE_shapes.png and SCENE_history.png; nothing else of the runs is kept.
/// @throws ConvergenceError if a run does not reach its end
BenchResult bench_scenes(const std::vector<std::filesystem::path>& scenes, const std::filesystem::path& pictures,
                         BenchObserver& observer);

/// The scene files of a folder sorted by name, or the given scene file.
/// @throws InputError if there are none
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& place);

/// Errors in space against the degree and the seconds: q and f_E of Example 1, and the velocity of a 2:1 prolate pulled
/// along and across its axis, whose exact velocity is constant, with the poles of the grid off the axis. All errors are
/// relative maxima over the nodes.
/// @throws ConvergenceError
BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer);

/// Orders and step sizes to measure.
struct TimeTask {
  Scene scene;
  double at = 0.0;                   ///< time at which the history quantities are compared
  std::vector<double> steps{};       ///< fixed step sizes, each half of the one before
  std::vector<int> time_orders{};    ///< integrators that take them; empty: that of the scene
  std::vector<double> tolerances{};  ///< in falling order
  SnapshotTimes snapshots{};         ///< with a tolerance, these and the start are compared too
  int repeats = 1;
};

/// Error of the history quantities against the step size, the steps and the seconds, for each integrator and for
/// tolerances; with fixed steps also the values, the order observed from the last three and their extrapolated limit.
/// The reference is the run with the last tolerance; without tolerances it is a run of the highest order, with half the
/// smallest step if orders above 2 are compared, otherwise with the middle one. Errors are maxima over all rows and
/// vesicles, relative to the largest value of the quantity there; errors of angles are in radians. Values are of the
/// first vesicle. Beside tolerances, which choose the degree, errors of fixed steps are also taken from the reference
/// of fixed steps, at the same degree: the errors of the steps only. A last table has the cost of one more digit with
/// each integrator that has three known errors.
/// @throws InputError, ConvergenceError
BenchResult bench_time(const TimeTask& task, BenchObserver& observer);

/// Seconds of the first step of the scene, and of each part of a steady step with its memory, against the degree.
/// @param orders  ascending
/// @throws InputError if the scene has no dt
BenchResult bench_parts(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

/// 1, 2, 4, … and the number of hardware threads.
std::vector<int> thread_counts();

/// Seconds of each part of a step of the scene against the number of threads, speed-up and efficiency relative to the
/// first count, and the difference of the state after the same steps from that of the first count. Repeats cycle
/// through the counts, so that all have the same load of the machine.
/// @throws InputError if the scene has no dt
BenchResult bench_threads(Scene scene, const std::vector<int>& counts, int repeats, BenchObserver& observer);

/// Seconds of a step of the scene at each degree with its symmetry and with the full solver, and the difference of the
/// states after the same steps. The two solvers step alternately, so that both have the same load of the machine.
/// @throws InputError if the scene has no dt or no symmetry
BenchResult bench_symmetry(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

/// Extent of the measurement.
struct MethodsTask {
  bool quick = false;  ///< two levels of each method
  int repeats = 3;
};

/// Boundary integrals against finite elements, both on one thread: the point sources of Example 1 on shape (33), whose
/// solution is known, and in a further table all fields that a step solves for, see ShapeFlowProblem.
/// @param folder  for files, which are deleted at the end
/// @throws InputError if the finite-element program is missing
BenchResult bench_methods(const MethodsTask& task, const std::filesystem::path& folder, BenchObserver& observer);

/// Hard cases to run, and the destination of their files.
struct StabilityTask {
  std::vector<std::filesystem::path> scenes;  ///< with their criteria, see StabilityCase
  /// Each run has its own folder below `runs`, emptied first; its first and last shape go to shapes/NAME.png.
  BenchOutput output;
  bool brief = false;  ///< runs the short form of every case
};

/// Outcome of the cases.
struct StabilityOutcome {
  BenchResult result;
  int n_failed = 0;
};

/// Draws the shapes of one case, small, into a folder.
/// @param paths  of its run, in a folder with the name of the case
/// @return path of the picture
/// @throws InputError if the run cannot be read or gnuplot is missing
std::filesystem::path draw_case(const RunPaths& paths, const std::filesystem::path& folder);

/// Runs every case as `vehd run` does and prints for each the criterion that is closest to its bound. Further tables
/// are for the pages: "pictures" with the shapes, which pages take from images/hard_cases, "families" with one row for
/// each family, and "faults" with the cases whose verdict names a fault.
/// @throws InputError for a scene or criterion that cannot be read, Interrupted
StabilityOutcome bench_stability(const StabilityTask& task, Interruption& interruption, BenchObserver& observer);

/// Benches to run, and the pages that they renew.
struct AllTask {
  std::filesystem::path docs;  ///< folder with the pages, images/ and scenes/
  BenchOutput output;
  bool quick = false;               ///< few degrees, tolerances and repeats: tests the benches, measures little
  std::vector<std::string> only{};  ///< names of benches; empty: all
};

/// Names in the order in which the benches run.
std::vector<std::string> names_of_benches();

/// Runs every scene, every bench and the commands with which pages make their own pictures, and renews the pictures and
/// the tables of the pages from the results. Benches of the finite elements are left out, with a note, if these are not
/// built.
/// @return name and machine of every bench
/// @throws InputError if there are no pages
nlohmann::ordered_json bench_all(const AllTask& task, BenchObserver& observer);

}  // namespace vehd
