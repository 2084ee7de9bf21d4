#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/runs/history.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/reference_run.hpp"

namespace {

/// Switched on at 0.6, between snapshots, and off at 1, at a snapshot.
std::string switched_scene(const std::string& end_time) {
  return quick_scene(end_time) + "[electric.waveform]\nkind = \"pulse\"\nstart = 0.6\nduration = 0.4\n";
}

const std::vector<std::string> columns_of_the_state = {
    "area",       "volume",          "reduced_volume", "bending_energy_scaled",
    "Vm_north",   "Vm_max",          "extent_x",       "extent_y",
    "extent_z",   "inclination_deg", "area_drift",     "volume_drift",
    "strain_max", "spectrum_tail",   "order",          "truncation",
    "separation"};

}  // namespace

BOOST_AUTO_TEST_SUITE(switch_rows)

BOOST_AUTO_TEST_CASE(history_has_both_sides_of_every_switch) {
  const ReferenceRun run(switched_scene("1.5"));
  const vehd::HistoryTable history(run.reference + "/history.csv");
  const std::vector<double>& time = history.column("time");
  const std::vector<double>& dt = history.column("dt");
  std::vector<std::size_t> second;
  for (std::size_t row = 1; row < history.n_rows(); ++row) {
    BOOST_TEST(time[row] >= time[row - 1]);
    BOOST_TEST((dt[row] == 0.0) == (time[row] == time[row - 1]));
    if (time[row] == time[row - 1]) second.push_back(row);
  }
  BOOST_TEST_REQUIRE(second.size() == 2U);
  BOOST_TEST(std::abs(time[second[0]] - 0.6) < 1e-12);
  BOOST_TEST(std::abs(time[second[1]] - 1.0) < 1e-12);
  for (const std::size_t row : second) {
    for (const std::string& column : columns_of_the_state) {
      BOOST_TEST(history.column(column)[row] == history.column(column)[row - 1], column);
    }
    BOOST_TEST(history.column("rejected")[row] == 0.0);
    BOOST_TEST(history.column("error_estimate")[row] == 0.0);
  }
  const std::vector<double>& charge = history.column("q_north");
  BOOST_TEST(charge[second[0] - 1] == 0.0);
  BOOST_TEST(charge[second[0]] != 0.0);
  // Just after the end of the pulse the charge is due to V_m only.
  BOOST_TEST(std::abs(charge[second[1]] - charge[second[1] - 1]) > 0.1 * std::abs(charge[second[1]]));

  const auto summary = json_of(run.reference + "/summary.json");
  const auto is_start_or_switch = static_cast<int>(std::count(dt.begin(), dt.end(), 0.0));
  BOOST_TEST(summary.at("steps").get<int>() == static_cast<int>(history.n_rows()) - is_start_or_switch);
}

BOOST_AUTO_TEST_CASE(snapshot_at_a_switch_holds_the_side_after_it) {
  const ReferenceRun run(switched_scene("1.0"));
  const vehd::RunReader snapshots(std::filesystem::path(run.reference + "/run.h5"));
  BOOST_TEST(snapshots.times() == (std::vector<double>{0.0, 0.5, 1.0}), boost::test_tools::per_element());
  const vehd::HistoryTable history(run.reference + "/history.csv");
  const std::vector<double>& north = history.column("q_north");
  const vehd::Matrix charge = snapshots.snapshot(2).coefficients("q");
  double at_pole = 0.0;
  for (int n = 0; n <= vehd::order_of(charge.rows()); ++n) {
    at_pole += charge(vehd::coefficient_index(n, 0), 0) * std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi));
  }
  BOOST_TEST(std::abs(at_pole - north.back()) < 1e-9 * std::abs(north.back()));
  BOOST_TEST(std::abs(at_pole - north[north.size() - 2]) > 0.1 * std::abs(north.back()));
}

BOOST_AUTO_TEST_CASE(runs_that_end_and_resume_around_a_switch_are_one_run) {
  const ReferenceRun one(switched_scene("1.5"));
  for (const char* end : {"0.5", "0.6", "1.0", "1.5"}) {
    write_text(one.scene, switched_scene(end));
    const ProgramResult result = run_command(one.command);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }
  BOOST_TEST((file_text(one.output + "/history.csv") == file_text(one.reference + "/history.csv")));
}

BOOST_AUTO_TEST_SUITE_END()
