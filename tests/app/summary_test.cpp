#include "bie/app/summary.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/app/progress.hpp"
#include "tests/app/program.hpp"

namespace {

/// Verdict of a run whose rows are these.
std::string verdict(const std::vector<vehd::HistoryRow>& rows, std::optional<double> tolerance = std::nullopt) {
  const TemporaryDirectory directory;
  vehd::HistoryFile file(directory / "history.csv", 0, 0);
  for (const vehd::HistoryRow& row : rows) file.append(row);
  return vehd::verdict_of(vehd::HistoryTable(directory / "history.csv"), tolerance);
}

vehd::HistoryRow row_at(double time, double area_drift, double strain) {
  vehd::HistoryRow row;
  row.time = time;
  row.diagnostics.area_drift = area_drift;
  row.diagnostics.strain_max = strain;
  return row;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(summary)

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

BOOST_AUTO_TEST_CASE(durations_are_readable) {
  BOOST_TEST(vehd::duration_text(0.25) == "0.2 s");
  BOOST_TEST(vehd::duration_text(59.4) == "59 s");
  BOOST_TEST(vehd::duration_text(125.0) == "2:05");
  BOOST_TEST(vehd::duration_text(3723.0) == "1:02:03");
}

BOOST_AUTO_TEST_SUITE_END()
