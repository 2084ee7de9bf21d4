#include "bie/runs/verdict.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/reader.hpp"
#include "tests/support/files.hpp"

namespace {

/// Verdict of a run with these rows.
std::string judged(const std::vector<vehd::HistoryRow>& rows, const vehd::TrustDemands& demands = {},
                   const std::string& stop_reason = {}) {
  const TemporaryDirectory directory;
  vehd::HistoryFile file(directory / "history.csv", 0, 0);
  for (const vehd::HistoryRow& row : rows) file.append(row);
  return vehd::verdict_of(vehd::HistoryTable(directory / "history.csv"), demands, stop_reason);
}

vehd::HistoryRow row_at(double time, double area_drift, double strain) {
  vehd::HistoryRow row;
  row.time = time;
  row.diagnostics.vesicles.resize(1);
  row.diagnostics.vesicles[0].area_drift = area_drift;
  row.diagnostics.vesicles[0].strain_max = strain;
  return row;
}

struct Values {
  double time = 0.0;
  double tension = 0.0;
  double tail = 1.0;  ///< in units of 1e-4
  int order = 10;
};

vehd::HistoryRow row_of(const Values& values) {
  vehd::HistoryRow row = row_at(values.time, 0, 0);
  row.diagnostics.vesicles[0].tension_integral = values.tension;
  row.diagnostics.vesicles[0].spectrum_tail = 1e-4 * values.tail;
  row.order = values.order;
  return row;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(verdict)

BOOST_AUTO_TEST_CASE(good_numbers_are_trustworthy) {
  BOOST_TEST(judged({row_at(0, 0, 0), row_at(1, -1e-7, 0.01)}) == "trustworthy");
}

BOOST_AUTO_TEST_CASE(verdict_says_which_number_and_since_when) {
  BOOST_TEST(judged({row_at(0, 0, 0), row_at(1, -2e-6, 0), row_at(2, 1e-6, 0), row_at(3, 5e-6, 0.1)}) ==
             "area_drift above 1e-06 since time 1 (worst 5e-06); strain_max above 0.05 since time 3 (worst 0.1)");
}

BOOST_AUTO_TEST_CASE(not_a_number_is_not_trustworthy) {
  BOOST_TEST(judged({row_at(0, 0, 0), row_at(1, std::nan(""), 0)}).find("area_drift above") == 0);
}

BOOST_AUTO_TEST_CASE(degree_that_the_tolerance_finds_too_low_is_reported) {
  vehd::HistoryRow row = row_at(1, 0, 0);
  row.truncation = 2e-4;
  BOOST_TEST(judged({row_at(0, 0, 0), row}) == "trustworthy");
  BOOST_TEST(judged({row_at(0, 0, 0), row}, {1e-3}) == "trustworthy");
  BOOST_TEST(judged({row_at(0, 0, 0), row}, {1e-4}) == "truncation above 0.0001 since time 1 (worst 0.0002)");
}

BOOST_AUTO_TEST_CASE(only_an_inextensible_membrane_has_to_keep_its_area) {
  const auto judged_as = [](const std::string& membrane) {
    const vehd::Scene scene = vehd::parse_scene(
        "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 2]\n[numerics]\ndt = 0.1\nend_time = 1\n[membrane]\n" + membrane,
        "scene.toml", ".");
    return judged({row_at(0, 0, 0), row_at(1, 0.1, 0.2)}, vehd::trust_demands(scene));
  };
  BOOST_TEST(judged_as("inextensible = false") == "trustworthy");
  BOOST_TEST(judged_as("inextensible = true").find("area_drift above") == 0u);
  vehd::HistoryRow leaky = row_at(1, 0.1, 0.2);
  leaky.diagnostics.vesicles[0].volume_drift = 1e-3;
  BOOST_TEST(judged({row_at(0, 0, 0), leaky}, {.keeps_area = false}).find("volume_drift above") == 0u);
}

BOOST_AUTO_TEST_CASE(a_tolerance_does_not_cover_pores) {
  const std::vector<vehd::HistoryRow> rows = {row_at(0, 0, 0), row_at(1, 0, 0)};
  BOOST_TEST(judged(rows, {.tolerance = 1e-3, .porates = true}).find("not covered by the tolerance") !=
             std::string::npos);
  BOOST_TEST(judged(rows, {.porates = true}) == "trustworthy");
}

BOOST_AUTO_TEST_CASE(wrinkles_finer_than_the_degree_are_named_where_something_is_wrong) {
  vehd::HistoryRow compressed = row_at(1, 0, 0);
  compressed.order = 10;
  compressed.diagnostics.vesicles[0].wrinkle_degree = 20.0;
  const std::string wrinkles =
      "compressed since time 1: wrinkles of wavelength 0.31 radii grow fastest "
      "(degree 10 resolves wavelengths down to 0.63)";
  BOOST_TEST(judged({row_at(0, 0, 0), compressed}) == "trustworthy");
  BOOST_TEST(judged({row_at(0, 0, 0), compressed}, {}, "no acceptable step") ==
             "stopped: no acceptable step; until then " + wrinkles);
  compressed.truncation = 0.1;
  BOOST_TEST(judged({row_at(0, 0, 0), compressed}, {1e-3}) ==
             "truncation above 0.001 since time 1 (worst 0.1); " + wrinkles);
  compressed.diagnostics.vesicles[0].wrinkle_degree = 9.0;
  BOOST_TEST(judged({row_at(0, 0, 0), compressed}, {1e-3}) == "truncation above 0.001 since time 1 (worst 0.1)");
}

// Starting from 1e-4, a growth by e³ = 20 gives 2e-3, one by e⁸ gives 0.3.
BOOST_AUTO_TEST_CASE(wrinkles_that_had_the_time_to_grow_unseen_are_reported) {
  const auto compressed = [](double time, double growth, double degree = 20.0, double truncation = 1e-4) {
    vehd::HistoryRow row = row_at(time, 0, 0);
    row.order = 10;
    row.truncation = truncation;
    row.diagnostics.vesicles[0].wrinkle_degree = degree;
    row.step.dt = 0.5;
    row.diagnostics.vesicles[0].wrinkling_rate = 2.0 * growth;
    return row;
  };
  const std::string wrinkles =
      "compressed since time 0: wrinkles of wavelength 0.31 radii grow fastest (degree 10 resolves "
      "wavelengths down to 0.63), and a truncation error of 0.0001 may have grown ";
  BOOST_TEST(judged({compressed(0, 5), compressed(1, 3)}) == wrinkles + "3e+03 times");
  BOOST_TEST(judged({compressed(0, 2), compressed(1, 1)}) == "trustworthy");
  BOOST_TEST(judged({compressed(0, 2), compressed(1, 1)}, {1e-3}) == wrinkles + "2e+01 times");
  // Without truncation nothing can grow.
  BOOST_TEST(judged({compressed(0, 5, 20.0, 0.0), compressed(1, 3)}) == "trustworthy");
  // The wrinkles are resolved, and hence controlled by the tolerance.
  BOOST_TEST(judged({compressed(0, 5, 9.0), compressed(1, 3, 9.0)}) == "trustworthy");
  // Wrinkles that grew before the membrane was stretched are gone.
  BOOST_TEST(judged({compressed(0, 2), compressed(1, 1), compressed(2, 0, 0.0), compressed(3, 2), compressed(4, 1)}) ==
             "trustworthy");
}

BOOST_AUTO_TEST_CASE(run_that_stopped_says_so_and_why) {
  const std::vector<vehd::HistoryRow> good = {row_at(0, 0, 0), row_at(1, 0, 0)};
  BOOST_TEST(judged(good, {}, "no acceptable step") == "stopped: no acceptable step");
  BOOST_TEST(judged({row_at(0, 0, 0), row_at(1, 0, 0.1)}, {1e-3}, "a signal came") ==
             "stopped: a signal came; until then strain_max above 0.05 since time 1 (worst 0.1)");
  BOOST_TEST(judged({}, {}, "no start") == "stopped: no start");
}

BOOST_AUTO_TEST_CASE(steps_that_ring_are_seen) {
  // Growth for some steps, then damping, then growth again, as with the first-order step near a sphere.
  const auto rows = [](double tension_swing, double tail_factor) {
    std::vector<vehd::HistoryRow> result;
    for (int i = 0; i < 60; ++i) {
      const bool high = i % 3 == 0;
      result.push_back(row_of(
          {.time = 0.05 * i, .tension = 440.0 - (high ? tension_swing : 0.0), .tail = high ? tail_factor : 1.0}));
    }
    return result;
  };
  BOOST_TEST(judged(rows(40.0, 5.0)).starts_with("tension_integral and spectrum_tail swing from step to step since "),
             judged(rows(40.0, 5.0)));
  BOOST_TEST(judged(rows(40.0, 5.0), {1e-3}).find("swing") != std::string::npos);
  BOOST_TEST(judged(rows(1.0, 5.0)) == "trustworthy");
  BOOST_TEST(judged(rows(40.0, 1.5)) == "trustworthy");
}

BOOST_AUTO_TEST_CASE(jumps_collapses_and_changes_of_degree_are_no_ringing) {
  std::vector<vehd::HistoryRow> pulses, collapse, degrees;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.01 * i;
    // A train of pulses of one step each moves the shape smoothly.
    pulses.push_back(row_of({.time = t, .tension = i % 4 == 0 ? -300.0 : 40.0, .tail = 1.0 + 0.5 * std::sin(t)}));
    // The tail rises by four decades within ten steps, while the tension falls.
    const double part = 0.5 * (1.0 + std::tanh(20.0 * (t - 1.0)));
    collapse.push_back(row_of({.time = t, .tension = 400.0 - 900.0 * part, .tail = std::pow(10.0, -3.0 + 4.0 * part)}));
    const bool raised = i / 7 % 2 == 1;
    degrees.push_back(
        row_of({.time = t, .tension = raised ? 400.0 : 380.0, .tail = raised ? 0.01 : 1.0, .order = raised ? 12 : 8}));
  }
  BOOST_TEST(judged(pulses) == "trustworthy");
  BOOST_TEST(judged(collapse) == "trustworthy");
  BOOST_TEST(judged(degrees, {0.1}) == "trustworthy");
}

BOOST_AUTO_TEST_CASE(fixed_steps_that_fail_again_and_again_are_seen) {
  const auto rows = [](int every) {
    std::vector<vehd::HistoryRow> result;
    for (int i = 0; i <= 100; ++i) {
      result.push_back(row_at(0.1 * i, 0, 0));
      result.back().step.rejected = i > 0 && i % every == 0 ? 2 : 0;
    }
    return result;
  };
  BOOST_TEST(judged(rows(5)) == "attempts failed before 20 of 100 steps, first at time 0.5");
  BOOST_TEST(judged(rows(12)) == "trustworthy");
  BOOST_TEST(judged(rows(5), {1e-3}) == "trustworthy");
  // One step in three, but of only a few steps.
  std::vector<vehd::HistoryRow> few = rows(3);
  few.resize(20);
  BOOST_TEST(judged(few) == "trustworthy");
}

BOOST_AUTO_TEST_SUITE_END()
