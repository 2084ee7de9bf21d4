#include "bie/app/verdict.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/files.hpp"

namespace {

/// Verdict of a run whose rows are these.
std::string verdict(const std::vector<vehd::HistoryRow>& rows, std::optional<double> tolerance = std::nullopt,
                    const std::string& stop_reason = {}) {
  const TemporaryDirectory directory;
  vehd::HistoryFile file(directory / "history.csv", 0, 0);
  for (const vehd::HistoryRow& row : rows) file.append(row);
  return vehd::verdict_of(vehd::HistoryTable(directory / "history.csv"), tolerance, stop_reason);
}

vehd::HistoryRow row_at(double time, double area_drift, double strain) {
  vehd::HistoryRow row;
  row.time = time;
  row.diagnostics.area_drift = area_drift;
  row.diagnostics.strain_max = strain;
  return row;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(verdict)

BOOST_AUTO_TEST_CASE(good_numbers_are_trustworthy) {
  BOOST_TEST(verdict({row_at(0, 0, 0), row_at(1, -1e-7, 0.01)}) == "trustworthy");
}

BOOST_AUTO_TEST_CASE(verdict_says_which_number_and_since_when) {
  BOOST_TEST(verdict({row_at(0, 0, 0), row_at(1, -2e-6, 0), row_at(2, 1e-6, 0), row_at(3, 5e-6, 0.1)}) ==
             "area_drift above 1e-06 since time 1 (worst 5e-06); strain_max above 0.05 since time 3 (worst 0.1)");
}

BOOST_AUTO_TEST_CASE(not_a_number_is_not_trustworthy) {
  BOOST_TEST(verdict({row_at(0, 0, 0), row_at(1, std::nan(""), 0)}).find("area_drift above") == 0);
}

BOOST_AUTO_TEST_CASE(degree_that_the_tolerance_finds_too_low_is_reported) {
  vehd::HistoryRow row = row_at(1, 0, 0);
  row.truncation = 2e-4;
  BOOST_TEST(verdict({row_at(0, 0, 0), row}) == "trustworthy");
  BOOST_TEST(verdict({row_at(0, 0, 0), row}, 1e-3) == "trustworthy");
  BOOST_TEST(verdict({row_at(0, 0, 0), row}, 1e-4) == "truncation above 0.0001 since time 1 (worst 0.0002)");
}

BOOST_AUTO_TEST_CASE(run_that_stopped_says_so_and_why) {
  const std::vector<vehd::HistoryRow> good = {row_at(0, 0, 0), row_at(1, 0, 0)};
  BOOST_TEST(verdict(good, {}, "no acceptable step") == "stopped: no acceptable step");
  BOOST_TEST(verdict({row_at(0, 0, 0), row_at(1, 0, 0.1)}, 1e-3, "a signal came") ==
             "stopped: a signal came; until then strain_max above 0.05 since time 1 (worst 0.1)");
  BOOST_TEST(verdict({}, {}, "no start") == "stopped: no start");
}

BOOST_AUTO_TEST_SUITE_END()
