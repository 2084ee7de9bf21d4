#include "bie/estimate/cost_table.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/scene/reader.hpp"
#include "tests/estimate/kept_costs.hpp"
#include "tests/support/scenes.hpp"

namespace {

/// Cost tables of a quick scene with a cache that starts empty, from so many steps of trial runs: the same at any
/// speed.
struct QuickScene {
  TemporaryDirectory directory;
  std::string cache = directory / "costs.json";
  std::string scene = quick_scene("1.0");

  std::vector<vehd::CostRow> read(std::int64_t steps = 1) const {
    write_text(directory / "scene.toml", scene);
    vehd::CostCache costs(cache);
    return vehd::cost_table_of(vehd::read_scene(directory / "scene.toml"), {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7},
                               costs, {.model_seconds = 0.0, .steps = steps});
  }

  [[nodiscard]] bool is_read_from_cache() const { return read().front().steps == kForged; }
};

bool is_measured(const vehd::CostRow& row) { return row.measured; }

}  // namespace

BOOST_AUTO_TEST_SUITE(cost_table)

BOOST_FIXTURE_TEST_CASE(every_digit_has_a_price_and_no_digit_is_free, QuickScene) {
  for (const std::int64_t steps : {1, 60, 600}) {
    const std::vector<vehd::CostRow> rows = read(steps);
    BOOST_TEST_REQUIRE(rows.size() == 7);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      BOOST_TEST(rows[i].tolerance < rows[i - 1].tolerance);
      BOOST_TEST(rows[i].order >= rows[i - 1].order);
      BOOST_TEST(rows[i].steps >= rows[i - 1].steps);
      BOOST_TEST(rows[i].memory_bytes >= rows[i - 1].memory_bytes);
      BOOST_TEST(rows[i].memory_bytes > 1000000);
      BOOST_TEST(rows[i].seconds > 0.0);
    }
  }
}

BOOST_FIXTURE_TEST_CASE(trial_runs_measure_as_many_digits_as_their_budget_allows, QuickScene) {
  const auto n_measured = [this](std::int64_t steps) {
    const std::vector<vehd::CostRow> rows = read(steps);
    // The loosest ones, and no other.
    BOOST_TEST(std::is_partitioned(rows.begin(), rows.end(), is_measured));
    std::int64_t used = 0;
    for (const vehd::CostRow& row : rows) used += row.measured ? row.steps : 0;
    BOOST_TEST(used <= steps);
    return std::count_if(rows.begin(), rows.end(), is_measured);
  };
  BOOST_TEST(n_measured(1) == 0);
  const auto some = n_measured(60), more = n_measured(600);
  BOOST_TEST(some >= 1);
  BOOST_TEST(more > some);
}

BOOST_FIXTURE_TEST_CASE(degrees_and_steps_from_steps_of_trial_runs_do_not_depend_on_the_clock, QuickScene) {
  const std::vector<vehd::CostRow> rows = read(60), again = QuickScene().read(60);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    BOOST_TEST((rows[i].order == again[i].order && rows[i].steps == again[i].steps));
    BOOST_TEST(rows[i].measured == again[i].measured);
  }
}

BOOST_FIXTURE_TEST_CASE(another_scene_is_another_cost_table, QuickScene) {
  read();
  forge(cache);
  BOOST_TEST(is_read_from_cache());
  scene = quick_scene("2.0");
  BOOST_TEST(!is_read_from_cache());
}

BOOST_FIXTURE_TEST_CASE(damaged_or_foreign_cache_is_made_again, QuickScene) {
  read();
  forge(cache);
  const std::string whole = file_text(cache);
  write_text(cache, whole.substr(0, whole.size() / 2));
  BOOST_TEST(!is_read_from_cache());
  BOOST_TEST(json_of(cache)["entries"]["cost table"].size() == 1);

  for (const char* part : {"commit", "processor", "threads", "version"}) {
    forge(cache);
    nlohmann::json foreign = json_of(cache);
    foreign["key"][part] = "another";
    write_text(cache, foreign.dump());
    BOOST_TEST(!is_read_from_cache(), part);
  }

  const std::vector<vehd::CostRow> rows = read();
  for (const char* entries :
       {"[]", "7", R"({"cost table": 3})", R"({"cost table": {}, "seconds per shape": [1, "x"]})"}) {
    nlohmann::json odd = json_of(cache);
    odd["entries"] = nlohmann::json::parse(entries);
    write_text(cache, odd.dump());
    BOOST_TEST(read().back().steps == rows.back().steps, entries);
  }
}

BOOST_FIXTURE_TEST_CASE(cache_that_cannot_be_written_is_no_error, QuickScene) {
  // A file where the folder should be: root may write into any folder.
  write_text(directory / "occupied", "");
  cache = directory / "occupied/costs.json";
  BOOST_TEST(read().size() == 7);
  BOOST_TEST(file_text(directory / "occupied").empty());
}

BOOST_AUTO_TEST_SUITE_END()
