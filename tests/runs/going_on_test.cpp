#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/runs/summary.hpp"
#include "bie/scene/reader.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/interruption.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(going_on)

namespace {

vehd::Scene relaxing() {
  return vehd::parse_scene(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.4]\n[membrane]\nbending_modulus = 1.0\n"
      "[numerics]\ndegree = 8\ndt = 0.05\nend_time = 0.4\n[output]\nevery = 0.1\n",
      "scene.toml", ".");
}

/// A field that is switched on and off again; the steps before each switch start by extrapolation.
vehd::Scene switched(const std::string& membrane = {}) {
  return vehd::parse_scene(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.4]\n[membrane]\nbending_modulus = 1.0\ncapacitance = 1.0\n" +
          membrane +
          "[electric]\nfield = [0.0, 0.0, 0.5]\nconductivity_in = 0.5\nconductivity_out = 1.0\n"
          "[electric.waveform]\nkind = \"pulse\"\nstart = 0.6\nduration = 0.4\n"
          "[numerics]\ntolerance = 1e-3\nend_time = 1.4\n[output]\nevery = 0.5\n",
      "scene.toml", ".");
}

struct Directory {
  TemporaryDirectory temporary;
  vehd::RunPaths paths{temporary / "run"};

  Directory() { vehd::make_directory(paths.directory); }
  [[nodiscard]] vehd::Checkpoint checkpoint() const { return vehd::read_checkpoint(paths.checkpoint()); }
};

/// Takes this many steps.
void go_on(vehd::RecordedRun& run, int n_steps) {
  run.start();
  for (; n_steps > 0; --n_steps) run.step();
}

}  // namespace

// Rows and snapshots that the checkpoint does not count are computed again.
BOOST_AUTO_TEST_CASE(steps_behind_the_checkpoint_are_made_again) {
  const vehd::Scene scene = relaxing();
  constexpr int kAll = 8;
  const Directory whole, killed;
  const std::optional<vehd::Checkpoint> none;
  {
    vehd::RecordedRun run({scene, whole.paths, none});
    go_on(run, kAll);
    run.end({.completed = true, .reason = {}});
  }
  {
    vehd::RecordedRun run(
        {.scene = scene, .paths = killed.paths, .checkpoint = none, .checkpoint_lag = std::chrono::hours(1)});
    go_on(run, 5);
    BOOST_TEST(killed.checkpoint().n_rows == 1);
    BOOST_TEST(killed.checkpoint().n_snapshots == 1);
  }
  const std::optional<vehd::Checkpoint> left = killed.checkpoint();
  vehd::RecordedRun run({scene, killed.paths, left});
  go_on(run, kAll);
  run.end({.completed = true, .reason = {}});
  BOOST_TEST(file_text(killed.paths.history()) == file_text(whole.paths.history()));
  BOOST_TEST(killed.checkpoint().n_snapshots == 5);
  BOOST_TEST(killed.checkpoint().snapshots_checksum == whole.checkpoint().snapshots_checksum);
}

namespace {

/// Just after a jump a checkpoint holds a state without history.
void check_going_on_from_each_step(const vehd::Scene& scene) {
  const Directory whole;
  const std::optional<vehd::Checkpoint> none;
  std::vector<vehd::State> states;
  {
    vehd::RecordedRun run({scene, whole.paths, none});
    run.start();
    while (run.simulation().evolution().state().time < scene.numerics.end_time) {
      run.step();
      states.push_back(run.simulation().evolution().state());
    }
    run.end({.completed = true, .reason = {}});
  }
  int n_jumps = 0, n_with_past = 0;
  for (std::size_t n = 1; n < states.size(); ++n) {
    const vehd::State& state = states[n - 1];
    const bool jumps = std::abs(state.time - 0.6) < 1e-12 || std::abs(state.time - 1.0) < 1e-12;
    n_jumps += jumps ? 1 : 0;
    n_with_past += state.past_times.size() > 0 ? 1 : 0;
    BOOST_TEST((jumps && state.past_times.size() > 0) == false);
    const Directory stopped;
    {
      vehd::RecordedRun run({scene, stopped.paths, none});
      go_on(run, static_cast<int>(n));
      run.end({.completed = false, .reason = "a signal"});
    }
    const std::optional<vehd::Checkpoint> left = stopped.checkpoint();
    vehd::RecordedRun run({scene, stopped.paths, left});
    go_on(run, static_cast<int>(states.size() - n));
    run.end({.completed = true, .reason = {}});
    BOOST_TEST((file_text(stopped.paths.history()) == file_text(whole.paths.history())), "stopped after step " << n);
  }
  BOOST_TEST(n_jumps == 2);
  BOOST_TEST(n_with_past > 0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_goes_on_bit_for_bit_from_each_of_its_steps) { check_going_on_from_each_step(switched()); }

BOOST_AUTO_TEST_CASE(a_run_with_undulations_goes_on_bit_for_bit_from_each_of_its_steps) {
  check_going_on_from_each_step(
      switched("undulations = true\ntemperature = 0.2\nstretching_modulus = 20\nreference_tension = 3\n"));
}

BOOST_AUTO_TEST_CASE(the_end_of_a_session_brings_the_checkpoint_up_to_date) {
  const vehd::Scene scene = relaxing();
  const Directory directory;
  const std::optional<vehd::Checkpoint> none;
  vehd::RecordedRun run(
      {.scene = scene, .paths = directory.paths, .checkpoint = none, .checkpoint_lag = std::chrono::hours(1)});
  go_on(run, 3);
  run.end({.completed = false, .reason = "a signal"});
  BOOST_TEST(directory.checkpoint().n_rows == 4);
  BOOST_TEST(directory.checkpoint().state.step == 3);
}

// The remaining motion would change the shape by less than the tolerance.
BOOST_AUTO_TEST_CASE(a_run_until_rest_ends_where_its_shape_does) {
  vehd::Scene scene = relaxing();
  scene.numerics.tolerance = 1e-3;
  scene.numerics.time_order = vehd::highest_time_order;
  scene.numerics.dt.reset();
  scene.numerics.end_time = 40.0;
  scene.output = {};
  vehd::Interruption interruption;
  const Directory whole, rested;
  BOOST_TEST(vehd::simulate({scene, whole.paths, {}}, interruption).completed);
  scene.numerics.until = vehd::RunsUntil::rest;
  BOOST_TEST(vehd::simulate({scene, rested.paths, {}}, interruption).completed);
  const vehd::HistoryTable all(whole.paths.history()), until(rested.paths.history());
  const double end = until.column("time").back();
  BOOST_TEST(end < 20.0);
  BOOST_TEST(until.column("shape_rate").back() * (40.0 - end) < 1e-3);
  BOOST_TEST(std::abs(until.column("extent_z").back() / all.column("extent_z").back() - 1.0) < 2e-3);
  // The last state is a snapshot, and a continued run ends at once.
  BOOST_TEST(vehd::RunReader(rested.paths.snapshots()).times().back() == end);
  vehd::RecordedRun run({scene, rested.paths, rested.checkpoint()});
  run.start();
  BOOST_TEST(run.simulation().at_end());
}

namespace {

/// Values of a column at the end of a run until rest.
double at_rest(const std::string& scene, const char* column) {
  const Directory folder;
  vehd::Interruption interruption;
  const std::string numerics = "[numerics]\ndegree = 8\ndt = 0.2\ntime_order = 2\nend_time = 40\nuntil = \"rest\"\n";
  BOOST_TEST(vehd::simulate({vehd::parse_scene(scene + numerics, "scene.toml", "."), folder.paths, {}}, interruption)
                 .completed);
  return vehd::HistoryTable(folder.paths.history()).column(column).back();
}

}  // namespace

// With equal fluids and an uncharged membrane the field exerts no force at first.
BOOST_AUTO_TEST_CASE(a_run_until_rest_waits_for_the_membrane_to_charge) {
  for (const char* mobile : {"mobile = false\n", "bending_modulus = 0.1\n"}) {
    const std::string scene = std::string("[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\n[membrane]\n") + mobile +
                              "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 1\n";
    BOOST_TEST(std::abs(at_rest(scene, "Vm_pole_plus")) == 1.5, boost::test_tools::tolerance(1e-3));
  }
}

// A sphere has no shape to change, but it sinks; at this height it meets the wall only later.
BOOST_AUTO_TEST_CASE(a_run_until_rest_waits_for_a_vesicle_that_sinks_to_a_wall) {
  const double left = at_rest(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\ncentre = [0, 0, 12]\n[fluid]\ndensity_difference = 1\n"
      "[gravity]\nacceleration = [0, 0, -1]\n[wall]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nflow = \"no-slip\"\n",
      "centroid_z");
  BOOST_TEST(left < 6.0);
}

BOOST_AUTO_TEST_CASE(a_run_until_rest_waits_for_its_waveforms) {
  vehd::Scene scene = switched();
  scene.shape.axes = {1.0, 1.0, 1.0};
  scene.membrane.inextensible = false;
  scene.numerics.until = vehd::RunsUntil::rest;
  vehd::Interruption interruption;
  const Directory folder;
  BOOST_TEST(vehd::simulate({scene, folder.paths, {}}, interruption).completed);
  BOOST_TEST(vehd::HistoryTable(folder.paths.history()).column("time").back() >= 1.0);
}

namespace {

/// History of an elongated vesicle in this flow with this viscosity ratio.
vehd::HistoryTable sheared(const Directory& directory, const char* flow, double viscosity_ratio, int order,
                           double end_time) {
  const vehd::Scene scene = vehd::parse_scene(
      fmt::format("[shape]\nkind = \"ellipsoid\"\naxes = [1.6, 1.0, 1.0]\n[membrane]\nbending_modulus = 0.1\n[fluid]\n"
                  "viscosity_ratio = {}\n[flow]\n{}\n[numerics]\ndegree = 8\ndt = 0.1\n"
                  "time_order = {}\nend_time = {}\n[output]\nevery = {}\n",
                  viscosity_ratio, flow, order, end_time, end_time),
      "scene.toml", ".");
  vehd::Interruption interruption;
  BOOST_TEST(vehd::simulate({scene, directory.paths, {}}, interruption).completed);
  return vehd::HistoryTable(directory.paths.history());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_viscous_vesicle_tumbles_where_another_one_tank_treads) {
  const char* shear = "kind = \"shear\"\nrate = 1.0";
  const char* about_z = "kind = \"gradient\"\ngradient = [[0, 1, 0], [0, 0, 0], [0, 0, 0]]";
  struct Case {
    const char* flow;
    double viscosity_ratio;
    int order;
    double end_time;
    std::string regime;
    double largest_difference;  // degrees; first-order steps leave a steady shape a velocity, and rows are spaced
  };
  for (const Case& one : {Case{shear, 1.0, 4, 12.0, "tank-treading", 0.1}, Case{shear, 14.0, 1, 24.0, "tumbling", 3.0},
                          Case{about_z, 14.0, 1, 24.0, "tumbling", 3.0}}) {
    const Directory directory;
    const vehd::HistoryTable history = sheared(directory, one.flow, one.viscosity_ratio, one.order, one.end_time);
    BOOST_TEST(vehd::regime_of(history, vehd::OutputUnits()) == one.regime);
    // The angle repeats after half a revolution.
    const auto& times = history.column("time");
    const auto& tumbling = history.column("tumbling_frequency");
    const auto& angle = history.column("tumbling_angle_deg");
    double turned = 0.0;
    for (std::size_t i = 1; i < times.size(); ++i) {
      turned += 180.0 * (times[i] - times[i - 1]) * (tumbling[i] + tumbling[i - 1]);
    }
    const double left = angle.back() - angle.front() - turned;
    BOOST_TEST(std::abs(std::remainder(left, 180.0)) < one.largest_difference);
  }
}

BOOST_AUTO_TEST_SUITE_END()
