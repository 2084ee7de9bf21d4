#include "bie/pictures/sweep_means.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/pictures/plots.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(sweep_means)

namespace {

/// Files of a sweep over a fraction, a field and a seed; some runs stopped early.
struct Table {
  TemporaryDirectory directory;

  Table() {
    write_text(directory / "sweep.json",
               R"({"mode": "grid", "columns": ["viscosity"], "keys": [{"name": "suspension.volume_fraction",
                  "scale": "linear"}, {"name": "electric.field", "scale": "linear"},
                  {"name": "suspension.seed", "scale": "linear"}]})");
    std::string rows =
        "suspension.volume_fraction,electric.field,suspension.seed,viscosity,verdict,reason,seconds,run\n";
    const auto add = [&](const std::string& keys, const std::string& number, const std::string& reason = "") {
      rows += keys + "," + number + ",fine," + reason + ",1.0,some\n";
    };
    for (const char* field : {"0", "2"}) {
      const std::string end = std::string(",") + field + ",";
      add("0.1" + end + "1", "2.0");
      add("0.1" + end + "2", "2.6");
      add("0.1" + end + "3", "2.9");
      add("0.2" + end + "1", "3.0");
      add("0.2" + end + "2", "7.0", "no acceptable step");
    }
    write_text(directory / "table.csv", rows);
  }
  [[nodiscard]] vehd::SweepRows rows() const { return vehd::SweepRows({directory / ""}); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(runs_that_differ_in_a_seed_are_one_mean_with_its_standard_error) {
  const Table table;
  const vehd::SweepRows rows = table.rows();
  BOOST_TEST_REQUIRE(vehd::seed_key(rows).value() == 2U);
  const std::vector<vehd::SweepMean> means = vehd::means_over_seeds(rows, 2, 0);
  BOOST_TEST_REQUIRE(means.size() == 4U);
  BOOST_TEST(means[0].values == (std::vector<std::string>{"0.1", "0"}), boost::test_tools::per_element());
  BOOST_TEST(means[0].n_runs == 3);
  BOOST_TEST(std::abs(means[0].mean - 2.5) < 1e-12);
  // Squared deviations 0.25 + 0.01 + 0.16, divided by 2 and by 3.
  BOOST_TEST(std::abs(means[0].error - std::sqrt(0.07)) < 1e-12);
  // Stopped runs do not count.
  BOOST_TEST(means[1].n_runs == 1);
  BOOST_TEST(means[1].mean == 3.0);
  BOOST_TEST(std::isnan(means[1].error));
}

BOOST_AUTO_TEST_CASE(means_are_drawn_and_written) {
  const Table table;
  vehd::SweepPlotTask task{{table.directory / ""}, {}, {}, {}, table.directory / "plots"};
  const auto files = vehd::plot_sweep(task);
  BOOST_TEST_REQUIRE(files.size() == 2U);
  BOOST_TEST(std::filesystem::file_size(files[0]) > 1000U);
  BOOST_TEST(file_text(files[1]) ==
             "suspension.volume_fraction,electric.field,viscosity,standard error,runs\n"
             "0.1,0,2.5,0.26,3\n0.2,0,3,nan,1\n0.1,2,2.5,0.26,3\n0.2,2,3,nan,1\n");
}

BOOST_AUTO_TEST_SUITE_END()
