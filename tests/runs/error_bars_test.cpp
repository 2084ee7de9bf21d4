#include "bie/runs/error_bars.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <sstream>

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/runs/worst_error.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shipped_scenes.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/thread_count.hpp"
#include "tests/support/files.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(error_bars, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

/// An ellipsoid that relaxes while a pulse charges it.
vehd::Scene pulsed(const std::string& numerics) {
  return vehd::parse_scene(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.4]\n[membrane]\nbending_modulus = 1.0\ncapacitance = 1.0\n"
      "[electric]\nfield = [0, 0, 2]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
      "[electric.waveform]\nkind = \"pulse\"\nduration = 0.23\n"
      "[numerics]\nend_time = 0.4\nerror_bars = true\n" +
          numerics,
      "scene.toml", ".");
}

/// A scene of docs/scenes with a tolerance.
vehd::Scene shipped(const std::string& name, double tolerance) {
  const auto& scenes = vehd::shipped_scenes();
  const auto found = std::ranges::find(scenes, name, &vehd::ShippedScene::name);
  BOOST_TEST_REQUIRE((found != scenes.end()));
  vehd::Scene scene = vehd::at_tolerance(vehd::parse_scene(std::string(found->text), "scene.toml", "."), tolerance);
  scene.numerics.error_bars = true;
  return scene;
}

/// A field of many periods; the period limits the steps of both runs.
vehd::Scene alternating(const std::string& tolerance) {
  return vehd::parse_scene(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.2]\n[membrane]\nbending_modulus = 0.01\ncapacitance = 1.0\n"
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
      "[electric.waveform]\nkind = \"ac\"\nfrequency = 2.0\n"
      "[numerics]\nend_time = 2\nerror_bars = true\ntolerance = " +
          tolerance + "\n[output]\nevery = 0.1",
      "scene.toml", ".");
}

/// A run in a directory of its own.
struct Files {
  TemporaryDirectory directory;
  vehd::RunPaths paths{directory / "run"};

  Files() { vehd::make_directory(paths.directory); }

  /// Takes this many steps, or runs to the end, and leaves the files as a kill would.
  void go_on(const vehd::Scene& scene, int n_steps = -1) const {
    std::optional<vehd::Checkpoint> checkpoint;
    if (std::filesystem::exists(paths.checkpoint())) checkpoint = vehd::read_checkpoint(paths.checkpoint());
    vehd::RecordedRun run({scene, paths, checkpoint});
    run.start();
    for (; n_steps != 0 && !run.simulation().at_end(); --n_steps) run.step();
  }
  [[nodiscard]] vehd::HistoryTable history() const { return vehd::HistoryTable(paths.history()); }
  [[nodiscard]] vehd::HistoryTable errors() const { return vehd::HistoryTable(paths.history_error()); }
};

/// Share of the rows in which the estimate is within a factor of five of the true error.
double share_of_good(const Files& run, const Files& exact, const std::string& column) {
  const vehd::HistoryTable values = run.history(), errors = run.errors(), reference = exact.history();
  BOOST_TEST_REQUIRE(errors.n_rows() == values.n_rows());
  BOOST_TEST_REQUIRE(reference.n_rows() == values.n_rows());
  int good = 0;
  for (std::size_t i = 1; i < values.n_rows(); ++i) {
    const double error = std::abs(values.column(column)[i] - reference.column(column)[i]);
    const double ratio = errors.column(column)[i] / error;
    if (ratio > 0.2 && ratio < 5.0) ++good;
  }
  return good / static_cast<double>(values.n_rows() - 1);
}

/// Shares of rows whose error bars hold.
struct Shares {
  double above_error = 0.0, below_30_errors = 0.0;
};

/// Compares the largest error of shape, energy, tension and potential, over the size of its column, with the largest
/// bar, in the rows at times `first`, `first` + `every`, ….
/// @param period  of the forcing, with which an error passes through zero: both are then the largest within a period
Shares shares_of(const Files& run, const Files& exact, double first, double every, double period = 0.0) {
  const vehd::HistoryTable values = run.history(), errors = run.errors(), reference = exact.history();
  BOOST_TEST_REQUIRE(errors.n_rows() == values.n_rows());
  std::vector<double> error, estimate;
  for (double time = first; time < values.column("time").back() + 0.5 * every; time += every) {
    const std::size_t i = vehd::testing::row_at(values, time), j = vehd::testing::row_at(reference, time);
    error.push_back(0.0);
    estimate.push_back(0.0);
    for (const char* column :
         {"extent_x", "extent_z", "bending_energy_scaled", "tension_integral", "Vm_north", "q_north"}) {
      const double size = values.largest_magnitude(column);
      if (!(size > 0.0)) continue;
      error.back() = std::max(error.back(), std::abs(values.column(column)[i] - reference.column(column)[j]) / size);
      estimate.back() = std::max(estimate.back(), errors.column(column)[i] / size);
    }
  }
  const auto n_rows = std::ssize(error), around = static_cast<std::ptrdiff_t>(std::floor(0.5 * period / every));
  const auto largest = [&](const std::vector<double>& of, std::ptrdiff_t row) {
    return *std::max_element(of.begin() + std::max<std::ptrdiff_t>(0, row - around),
                             of.begin() + std::min(n_rows, row + around + 1));
  };
  Shares shares;
  for (std::ptrdiff_t row = 0; row < n_rows; ++row) {
    const double wrong = largest(error, row), estimated = largest(estimate, row);
    if (estimated >= wrong) shares.above_error += 1.0 / static_cast<double>(n_rows);
    if (estimated <= 30.0 * wrong) shares.below_30_errors += 1.0 / static_cast<double>(n_rows);
  }
  return shares;
}

void check_nine_of_ten(const Shares& shares, const std::string& what) {
  BOOST_TEST(shares.above_error >= 0.9, shares.above_error << " above the error, " << what);
  BOOST_TEST(shares.below_30_errors >= 0.9, shares.below_30_errors << " below 30 times the error, " << what);
}

/// Largest error of a row, over the size of its column.
double worst_of(const vehd::HistoryTable& history, const vehd::HistoryTable& errors, std::size_t row) {
  double worst = 0.0;
  for (const std::string& name : history.names()) {
    const double size = vehd::size_of_column(history, name);
    if (size > 0.0) worst = std::max(worst, errors.column(name)[row] / size);
  }
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_of_fixed_size_estimate_their_error) {
  // The truncation error is smaller than the error of the steps: an estimate is never below a part of the truncation
  // error, which both runs have in common here.
  for (const std::string order : {"1", "2"}) {
    const Files run, exact;
    run.go_on(pulsed("degree = 10\ndt = 0.01\ntime_order = " + order));
    exact.go_on(pulsed("degree = 10\ndt = 0.01\ntime_order = 4"));
    for (const char* column : {"extent_z", "bending_energy_scaled", "Vm_north"}) {
      BOOST_TEST(share_of_good(run, exact, column) >= 0.9, column << " at order " << order);
    }
    const vehd::HistoryTable errors = run.errors(), history = run.history();
    BOOST_TEST(errors.column("time") == history.column("time"), boost::test_tools::per_element());
    BOOST_TEST(errors.largest_magnitude("dt") == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_tolerance_has_errors_at_every_row) {
  const Files run;
  run.go_on(pulsed("tolerance = 1e-2\n[output]\nevery = 0.05"));
  const vehd::HistoryTable errors = run.errors(), history = run.history();
  BOOST_TEST_REQUIRE(errors.n_rows() == history.n_rows());
  for (std::size_t i = 1; i < errors.n_rows(); ++i) {
    BOOST_TEST(errors.column("time")[i] == history.column("time")[i]);
    const double error = errors.column("extent_z")[i] / history.column("extent_z")[i];
    BOOST_TEST((error > 0.0 && error < 1e-2), error);
  }
  // The tension jumps with the field, and its error with it; neither is taken for the other.
  const nlohmann::json worst = vehd::worst_error(history, errors);
  BOOST_TEST(worst.at("worst").get<double>() < 0.05, worst.dump());
}

BOOST_AUTO_TEST_CASE(a_shape_at_rest_is_wrong_by_its_degrees_alone) {
  const auto relaxing = [](const std::string& tolerance) {
    return vehd::parse_scene(
        "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.9621762549176331]\n[membrane]\nbending_modulus = 1.0\n"
        "[numerics]\nend_time = 10\nerror_bars = true\ntolerance = " +
            tolerance + "\n[output]\nevery = 0.5",
        "scene.toml", ".");
  };
  const Files exact;
  exact.go_on(relaxing("1e-6"));
  for (const std::string tolerance : {"1e-2", "1e-3"}) {
    const Files run;
    run.go_on(relaxing(tolerance));
    // From this time on the error of the steps is less than a tenth of the truncation error.
    check_nine_of_ten(shares_of(run, exact, 7.0, 0.5), tolerance);
  }
}

BOOST_AUTO_TEST_CASE(largest_steps_of_both_make_differences) {
  for (const std::string tolerance : {"1e-2", "1e-2\ntime_order = 3", "1e-3\ntime_order = 3"}) {
    const Files run, exact;
    run.go_on(alternating(tolerance));
    exact.go_on(alternating("1e-5"));
    check_nine_of_ten(shares_of(run, exact, 0.1, 0.1, 0.5), tolerance);
  }
}

BOOST_AUTO_TEST_CASE(steps_that_the_charging_limits_make_differences) {
  const Files run, exact;
  run.go_on(shipped("two_step_pulse", 1e-3));
  exact.go_on(shipped("two_step_pulse", 1e-5));
  const double every = run.history().column("time").back() / 100.0;
  check_nine_of_ten(shares_of(run, exact, every, every), "two_step_pulse");
}

BOOST_AUTO_TEST_CASE(no_error_bar_is_less_than_a_part_of_the_truncation) {
  // The shape hardly changes any more; the degree falls, and at times the companion has the same degree.
  vehd::Scene scene = shipped("ac_field_averaged", 1e-3);
  scene.numerics.end_time *= 0.125;
  const Files run;
  run.go_on(scene);
  const vehd::HistoryTable history = run.history(), errors = run.errors();
  for (std::size_t i = history.n_rows() / 2; i < history.n_rows(); ++i) {
    const double worst = worst_of(history, errors, i);
    BOOST_TEST(worst >= 0.25 * history.column("truncation")[i], "row " << i << ": " << worst);
  }
}

BOOST_AUTO_TEST_CASE(a_resumed_run_has_the_same_errors_bit_for_bit) {
  for (const std::string numerics : {"degree = 6\ndt = 0.01", "tolerance = 1e-2\n[output]\nevery = 0.05"}) {
    const vehd::Scene scene = pulsed(numerics);
    const Files whole, parts;
    whole.go_on(scene);
    for (int part = 0; part < 4; ++part) parts.go_on(scene, 3);
    parts.go_on(scene);
    BOOST_TEST((file_text(parts.paths.history()) == file_text(whole.paths.history())));
    BOOST_TEST((file_text(parts.paths.history_error()) == file_text(whole.paths.history_error())));
  }
}

BOOST_AUTO_TEST_CASE(a_run_that_is_killed_at_any_of_its_first_steps_has_the_same_errors) {
  // With fixed steps the companion takes one step for two; with a tolerance its first step may pass several rows.
  for (const std::string numerics : {"degree = 4\ndt = 0.02", "tolerance = 1e-2\n[output]\nevery = 0.002"}) {
    vehd::Scene scene = pulsed(numerics);
    scene.numerics.end_time = 0.2;
    const Files whole;
    whole.go_on(scene);
    for (int steps = 0; steps < 4; ++steps) {
      const Files parts;
      parts.go_on(scene, steps);
      parts.go_on(scene, 1);
      parts.go_on(scene);
      BOOST_TEST((file_text(parts.paths.history_error()) == file_text(whole.paths.history_error())),
                 numerics << ", killed after " << steps << " steps");
    }
  }
}

BOOST_AUTO_TEST_CASE(a_companion_beside_the_run_makes_the_same_errors_bit_for_bit) {
  for (const std::string numerics : {"degree = 6\ndt = 0.01", "tolerance = 1e-2\n[output]\nevery = 0.05"}) {
    const vehd::Scene scene = pulsed(numerics);
    const Files alone, beside, mixed;
    const auto go_on = [&scene](const Files& files, int n_threads, int n_steps) {
      const vehd::ThreadCount threads(n_threads);
      files.go_on(scene, n_steps);
    };
    go_on(alone, 1, -1);
    go_on(beside, 2, -1);
    go_on(mixed, 2, 5);
    go_on(mixed, 1, -1);
    for (const Files* other : {&beside, &mixed}) {
      BOOST_TEST((file_text(other->paths.history()) == file_text(alone.paths.history())));
      BOOST_TEST((file_text(other->paths.history_error()) == file_text(alone.paths.history_error())));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_numerics_of_both_runs_are_unchanged) {
  const vehd::Scene before = pulsed("degree = 6\ndt = 0.01"), after = pulsed("degree = 6\ndt = 0.005");
  const Files run;
  run.go_on(before, 3);
  const vehd::SceneSource source{"scene.toml", {}, ""};
  const auto names_the_key = [](const vehd::InputError& error) {
    return std::string(error.what()).find("\"numerics.dt\" is 0.005") != std::string::npos &&
           std::string(error.what()).find("error_bars compare two runs from the start") != std::string::npos;
  };
  const vehd::Checkpoint checkpoint = vehd::read_checkpoint(run.paths.checkpoint());
  BOOST_CHECK_EXCEPTION(vehd::require_same_physics(after, source, checkpoint, run.paths), vehd::InputError,
                        names_the_key);
}

BOOST_AUTO_TEST_CASE(the_worst_error_is_that_over_the_size_of_its_column) {
  const auto table = [](const std::string& rows) {
    std::istringstream stream("time,extent_x,Vm_north,Vm_max,inclination_deg,dipole_x\n" + rows);
    return vehd::HistoryTable(stream, "history.csv");
  };
  // A quantity that vanishes by symmetry has errors of its own size, and the error of an angle is relative to a radian.
  const vehd::HistoryTable history = table("0,2,1e-18,1,0,0\n1,4,1e-18,1,0.1,0\n2,4,0,1,0,0\n");
  const vehd::HistoryTable errors = table("0,0,1e-18,0,0,1\n1,0.1,1e-18,0.02,0.05,1\n");
  const nlohmann::json worst = vehd::worst_error(history, errors);
  BOOST_TEST(worst.at("rows") == 2);
  BOOST_TEST(worst.at("column") == "extent_x");
  BOOST_TEST(worst.at("worst").get<double>() == 0.025);
  BOOST_TEST(worst.at("text") == "2.5e-02 of extent_x at time 1");
}

BOOST_AUTO_TEST_SUITE_END()
