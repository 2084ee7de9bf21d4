#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace {

nlohmann::json json_of(const std::string& path) { return nlohmann::json::parse(file_text(path)); }

/// The menu of a quick scene with a cache that starts empty.
struct Menu {
  OwnCache cache;
  TemporaryDirectory directory;

  Menu() { write_text(directory / "scene.toml", quick_scene("1.0")); }

  nlohmann::json read(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"plan", "--menu", directory / "scene.toml", "--json", directory / "menu.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    BOOST_TEST(result.errors.empty(), result.errors);
    return json_of(directory / "menu.json");
  }

  /// Gives every kept menu another number of steps, which no run would find.
  void change_kept_steps() {
    nlohmann::json kept = json_of(cache.file());
    for (auto& menu : kept["entries"]["menu"]) {
      for (auto& row : menu) row[2] = kForged;
    }
    write_text(cache.file(), kept.dump());
  }

  static constexpr int kForged = 12345;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(menu)

BOOST_AUTO_TEST_CASE(every_digit_has_a_price_and_no_digit_is_free) {
  Menu menu;
  const nlohmann::json rows = menu.read();
  BOOST_TEST(rows.size() == 7);
  BOOST_TEST(rows[0]["measured"].get<bool>());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    BOOST_TEST(rows[i]["tolerance"].get<double>() < rows[i - 1]["tolerance"].get<double>());
    BOOST_TEST(rows[i]["order"].get<int>() >= rows[i - 1]["order"].get<int>());
    BOOST_TEST(rows[i]["steps"].get<int>() >= rows[i - 1]["steps"].get<int>());
    BOOST_TEST(rows[i]["memory_bytes"].get<double>() >= rows[i - 1]["memory_bytes"].get<double>());
    BOOST_TEST(rows[i]["memory_bytes"].get<double>() > 1e6);
    BOOST_TEST(rows[i]["seconds"].get<double>() > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(second_call_reads_what_the_first_has_kept) {
  Menu menu;
  const nlohmann::json rows = menu.read();
  BOOST_TEST((menu.read() == rows));
  menu.change_kept_steps();
  BOOST_TEST(menu.read()[0]["steps"].get<int>() == Menu::kForged);
  BOOST_TEST(menu.read({"--fresh"})[0]["steps"].get<int>() == rows[0]["steps"].get<int>());
}

BOOST_AUTO_TEST_CASE(another_scene_is_another_menu) {
  Menu menu;
  menu.read();
  menu.change_kept_steps();
  write_text(menu.directory / "scene.toml", quick_scene("2.0"));
  BOOST_TEST(menu.read()[0]["steps"].get<int>() < Menu::kForged);
}

BOOST_AUTO_TEST_CASE(damaged_or_foreign_cache_is_made_again) {
  Menu menu;
  const int steps = menu.read()[0]["steps"].get<int>();
  const std::string whole = file_text(menu.cache.file());
  write_text(menu.cache.file(), whole.substr(0, whole.size() / 2));
  BOOST_TEST(menu.read()[0]["steps"].get<int>() == steps);
  BOOST_TEST(json_of(menu.cache.file())["entries"]["menu"].size() == 1);

  for (const char* part : {"commit", "processor", "threads", "version"}) {
    menu.change_kept_steps();
    nlohmann::json foreign = json_of(menu.cache.file());
    foreign["key"][part] = "another";
    write_text(menu.cache.file(), foreign.dump());
    BOOST_TEST(menu.read()[0]["steps"].get<int>() == steps, part);
  }

  for (const char* entries : {"[]", "7", R"({"menu": 3})", R"({"menu": {}, "seconds per shape": [1, "x"]})"}) {
    nlohmann::json odd = json_of(menu.cache.file());
    odd["entries"] = nlohmann::json::parse(entries);
    write_text(menu.cache.file(), odd.dump());
    BOOST_TEST(menu.read()[0]["steps"].get<int>() == steps, entries);
  }
}

BOOST_AUTO_TEST_CASE(cache_that_cannot_be_written_is_no_error) {
  Menu menu;
  // A file where the folder should be: root may write into any folder.
  write_text(menu.directory / "occupied", "");
  ::setenv("XDG_CACHE_HOME", (menu.directory / "occupied").c_str(), 1);
  BOOST_TEST(menu.read().size() == 7);
  BOOST_TEST(file_text(menu.directory / "occupied").empty());
}

BOOST_AUTO_TEST_SUITE_END()
