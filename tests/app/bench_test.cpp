#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "bie/bench/pages.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

/// One bench, run in its own folder.
struct Bench {
  TemporaryDirectory directory;
  std::string name;
  ProgramResult result;
  nlohmann::json json;

  explicit Bench(std::vector<std::string> arguments) : name(arguments.front()) {
    write_text(directory / "scene.toml", quick_scene("1.0"));
    for (std::string& argument : arguments) {
      if (argument == "SCENE") argument = directory / "scene.toml";
    }
    arguments.insert(arguments.begin(), "bench");
    arguments.insert(arguments.end(), {"-o", directory / "out", "--json", directory / "copy.json"});
    result = run_vehd(arguments);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    json = json_of(directory / ("out/" + name + ".json"));
    BOOST_TEST((json == json_of(directory / "copy.json")));
  }

  [[nodiscard]] std::string file(const std::string& end) const { return directory / ("out/" + name + end); }
};

void files_say_what_they_hold_for(const Bench& bench) {
  for (const char* key : {"processor", "hardware_threads", "threads", "compiler", "version", "commit"}) {
    BOOST_TEST(bench.json["machine"].contains(key), key);
  }
  BOOST_TEST(bench.json["repeats"].get<int>() >= 1);
  const std::string csv = file_text(bench.file(".csv"));
  BOOST_TEST(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == bench.json["rows"].size() + 1);
  // Every row has every column.
  const std::string heading = csv.substr(0, csv.find('\n'));
  const auto commas = std::count(heading.begin(), heading.end(), ',');
  BOOST_TEST(std::count(csv.begin(), csv.end(), ',') == commas * std::count(csv.begin(), csv.end(), '\n'));
  for (const auto& row : bench.json["rows"]) {
    for (const auto& [key, value] : row.items()) {
      if (!key.ends_with("_repeats") || value.is_null()) continue;
      const std::string timing = key.substr(0, key.size() - std::string("_repeats").size());
      BOOST_TEST(row[timing + "_min"].get<double>() <= row[timing].get<double>(), key);
      BOOST_TEST(row[timing].get<double>() <= row[timing + "_max"].get<double>(), key);
      BOOST_TEST(value.get<int>() <= bench.json["repeats"].get<int>(), key);
    }
  }
  BOOST_TEST(fs::file_size(bench.file(".png")) > 10000u);
}

/// Rows in which a key has the given value.
std::vector<nlohmann::json> rows_with(const Bench& bench, const std::string& key, const nlohmann::json& value) {
  std::vector<nlohmann::json> rows;
  for (const auto& row : bench.json["rows"]) {
    if (row[key] == value) rows.push_back(row);
  }
  return rows;
}

double number(const nlohmann::json& row, const std::string& key) { return row[key].get<double>(); }

/// Copies the pages and scenes, arranged as in the source tree, with small scenes.
void copy_docs(const fs::path& to) {
  const fs::path from = fs::path(VEHD_SOURCE_DIR) / "docs";
  fs::create_directories(to / "scenes");
  for (const fs::path& page : vehd::pages_of(from)) {
    fs::create_directories((to / page.lexically_relative(from)).parent_path());
    fs::copy_file(page, to / page.lexically_relative(from));
  }
  for (const auto& entry : fs::directory_iterator(from / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    write_text(to / "scenes" / entry.path().filename(), shortened_scene(file_text(entry.path())));
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(bench, *boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                 boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(errors_in_space_fall_with_the_degree) {
  const Bench bench({"space", "--orders", "6,12", "--repeats", "2"});
  files_say_what_they_hold_for(bench);
  const auto& rows = bench.json["rows"];
  BOOST_REQUIRE(rows.size() == 2);
  for (const char* error : {"error_q", "error_force", "error_velocity"}) {
    BOOST_TEST(number(rows[1], error) < 0.2 * number(rows[0], error), error);
  }
  // Bounds from docs/accuracy.md at p = 12.
  BOOST_TEST(number(rows[1], "error_q") < 1e-3);
  BOOST_TEST(number(rows[1], "error_force") < 6e-3);
  BOOST_TEST(number(rows[1], "error_velocity") < 1e-8);
  BOOST_TEST(number(rows[1], "error_velocity") > 1e-12);
  BOOST_TEST(number(rows[1], "paper_error_q") == 2.5e-3);
}

BOOST_AUTO_TEST_CASE(values_of_the_command_line_take_the_place_of_those_of_the_scene) {
  const Bench bench({"parts", "SCENE", "--orders", "8", "--repeats", "1", "--set", "numerics.dt=0.125"});
  BOOST_TEST(number(bench.json, "dt") == 0.125);
  BOOST_TEST(bench.json["scene"].get<std::string>().ends_with("scene.toml --set numerics.dt=0.125"));
}

BOOST_AUTO_TEST_CASE(parts_of_a_step_add_up_to_it) {
  const Bench bench({"parts", "SCENE", "--orders", "6,10", "--repeats", "1"});
  files_say_what_they_hold_for(bench);
  for (const auto& row : bench.json["rows"]) {
    double sum = 0.0;
    for (const auto& [key, value] : row.items()) {
      const bool part = key.starts_with("seconds_") && row.contains(key + "_repeats");
      if (part && key != "seconds_step") sum += value.get<double>();
    }
    BOOST_TEST(sum == number(row, "seconds_step"), boost::test_tools::tolerance(1e-9));
    // Negative if a part nested in another were counted twice.
    BOOST_TEST(number(row, "seconds_other") >= 0.0);
    BOOST_TEST(number(row, "seconds_operator_assembly") > 0.0);
    BOOST_TEST(number(row, "seconds_electric") > 0.0);
    BOOST_TEST(number(row, "first_step_seconds") > 0.0);
    // Both are measured in pages, over different intervals.
    constexpr double kPages = 4 * 4096.0;
    BOOST_TEST(number(row, "bytes_step") >= number(row, "bytes_operator_assembly") - kPages);
  }
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_the_result) {
  const Bench bench({"threads", "SCENE", "--threads", "1,3", "--order", "12", "--repeats", "2"});
  files_say_what_they_hold_for(bench);
  const auto steps = rows_with(bench, "part", "step");
  BOOST_REQUIRE(steps.size() == 2);
  BOOST_TEST(number(steps[0], "speed_up") == 1.0);
  BOOST_TEST(number(steps[0], "difference") == 0.0);
  BOOST_TEST(number(steps[1], "difference") < 1e-12);
  const double ratio = number(steps[0], "seconds") / number(steps[1], "seconds");
  BOOST_TEST(number(steps[1], "speed_up") == ratio, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(number(steps[1], "efficiency") == ratio / 3.0, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(rows_with(bench, "part", "operator assembly").size() == 2);
}

BOOST_AUTO_TEST_CASE(symmetry_does_not_change_the_result) {
  const Bench bench({"symmetry", "SCENE", "--orders", "6,8", "--repeats", "2"});
  files_say_what_they_hold_for(bench);
  BOOST_REQUIRE(bench.json["rows"].size() == 2);
  for (const auto& row : bench.json["rows"]) {
    BOOST_TEST(number(row, "ratio") == number(row, "seconds_full") / number(row, "seconds"),
               boost::test_tools::tolerance(1e-6));
    BOOST_TEST(number(row, "difference") < 1e-9 * number(row, "steps"));
    // An axisymmetric ellipsoid: the full solver has a whole circle of targets for each target of the reduced one.
    BOOST_TEST(number(row, "kernel_ratio") > number(row, "order"));
  }
}

BOOST_AUTO_TEST_CASE(errors_in_time_fall_with_the_step_as_the_order_says) {
  const Bench bench({"time", "SCENE", "--dt", "0.1,0.05,0.025", "--time-orders", "1,3", "--at", "0.4"});
  files_say_what_they_hold_for(bench);
  const auto first = rows_with(bench, "integrator", "order 1"), third = rows_with(bench, "integrator", "order 3");
  BOOST_REQUIRE(first.size() == 3);
  BOOST_REQUIRE(third.size() == 3);
  BOOST_TEST(std::log2(number(first[1], "error") / number(first[2], "error")) > 0.8);
  BOOST_TEST(std::log2(number(first[1], "error") / number(first[2], "error")) < 1.2);
  BOOST_TEST(number(third[2], "error") < 0.1 * number(first[2], "error"));
  BOOST_TEST(number(third[0], "steps") == 4);
  // For each of the two integrators: three values, the order and the limit.
  BOOST_TEST(bench.json["values"].size() == 10);
  // Times of such short runs are meaningless, but each further digit must multiply them by more than 1.
  for (const auto& row : bench.json["digits"]) {
    BOOST_TEST(number(row, "error_smallest") < number(row, "error_largest"));
    BOOST_TEST(number(row, "seconds_of_a_digit") > 1.0);
  }
}

BOOST_AUTO_TEST_CASE(errors_of_tolerances_are_those_asked_for) {
  const Bench bench({"time", "SCENE", "--tolerance", "1e-1,1e-2,1e-4", "--at", "1", "--repeats", "2"});
  files_say_what_they_hold_for(bench);
  const auto& rows = bench.json["rows"];
  BOOST_REQUIRE(rows.size() == 3);
  BOOST_TEST(number(rows[0], "seconds_repeats") == 2.0);
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST(number(rows[i], "error_over_tolerance") < 3.0);
    BOOST_TEST(number(rows[i], "error") == number(rows[i], "error_over_tolerance") * number(rows[i], "tolerance"),
               boost::test_tools::tolerance(1e-9));
  }
  BOOST_TEST(rows[2]["error"].is_null());
}

BOOST_AUTO_TEST_CASE(lists_out_of_order_are_refused) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", quick_scene("1.0"));
  const auto message = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", directory / "out"});
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 1);
    return result.errors;
  };
  const std::string scene = directory / "scene.toml";
  BOOST_TEST(message({"bench", "parts", scene, "--degrees", "10,6"}) ==
             "--degrees: 6 after a higher one; accepted: ascending\n");
  BOOST_TEST(message({"bench", "threads", scene, "--threads", "2,1"}) ==
             "--threads: 1 after a higher one; accepted: ascending\n");
  BOOST_TEST(message({"bench", "symmetry", scene, "--orders", "10,6"}) ==
             "--degrees: 6 after a higher one; accepted: ascending\n");
  std::string oblique = quick_scene("1.0");
  const std::string upright = "kind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]";
  oblique.replace(
      oblique.find(upright), upright.size(),
      "kind = \"radial\"\nmodes = [{n = 2, m = 1, a = 0.2}, {n = 3, m = 1, a = 0.1}, {n = 3, m = -2, a = 0.1}]");
  write_text(scene, oblique);
  BOOST_TEST(message({"bench", "symmetry", scene}) == "bench symmetry needs a scene that has one\n");
  write_text(scene, quick_scene("1.0"));
  BOOST_TEST(message({"bench", "time", scene, "--dt", "0.1,0.07", "--at", "1"}) == "--dt: 0.07 is not half of 0.1\n");
  BOOST_TEST(message({"bench", "time", scene, "--tolerance", "1e-3,1e-2", "--at", "1"}) ==
             "--tolerance: 0.01 is not below 0.001\n");
  BOOST_TEST(message({"bench", "all", "--docs", directory / "nowhere"}).find("no scenes") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(one_command_renews_every_table_and_picture_of_the_pages) {
  const TemporaryDirectory directory;
  const fs::path docs = directory / "docs";
  copy_docs(docs);
  copy_some_hard_cases(directory / "");
  write_text(docs / "extra.md",
             "before\n<!-- table space -->\nold\n<!-- end of table -->\nafter\n"
             "<!-- table unknown -->\nkept\n<!-- end of table -->\n");
  const ProgramResult result = run_vehd({"bench", "all", "--quick", "--docs", docs.string(), "-o", directory / "out"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);

  const std::string extra = file_text(docs / "extra.md");
  BOOST_TEST(extra.starts_with("before\n<!-- table space -->\n| p | error of q |"), extra);
  BOOST_TEST(extra.find("old") == std::string::npos);
  BOOST_TEST(extra.ends_with("after\n<!-- table unknown -->\nkept\n<!-- end of table -->\n"), extra);
  const bool methods = static_cast<bool>(finite_elements_are_built());
  // Every table of the pages is renewed, except the invented one and that of the finite elements if they are not built.
  const std::string left =
      methods ? "; tables left as they were: unknown\n" : "; tables left as they were: methods, unknown\n";
  BOOST_TEST(result.output.ends_with(left), result.output);
  BOOST_TEST((result.output.find("the finite elements are not built") == std::string::npos) == methods);

  write_text(docs / "extra.md", "<!-- table space -->\nold\n<!-- end of table -->\n");
  const std::vector<std::string> one = {"--docs", docs.string(), "-o", directory / "one", "--only", "space"};
  std::vector<std::string> arguments = {"bench", "all", "--quick"};
  arguments.insert(arguments.end(), one.begin(), one.end());
  const ProgramResult again = run_vehd(arguments);
  BOOST_TEST(again.exit_code == 0, again.errors);
  BOOST_TEST(file_text(docs / "extra.md").find("old") == std::string::npos);
  BOOST_TEST(again.output.find("== parts") == std::string::npos);

  // Every picture shown on a page is newly drawn here or made by a command of a page.
  std::vector<std::string> made;
  for (const fs::path& page : vehd::pages_of(docs)) {
    for (std::string& picture : vehd::pictures_of(vehd::commands_of_page(page))) made.push_back(std::move(picture));
  }
  for (const fs::path& page : vehd::pages_of(docs)) {
    const std::string text = file_text(page);
    const std::regex shown("\\]\\((\\.\\./)?(images/[^)]+)\\)");
    for (std::sregex_iterator match(text.begin(), text.end(), shown), end; match != end; ++match) {
      const std::string image = (*match)[2];
      if (!methods && image.starts_with("images/bench_methods")) continue;
      BOOST_TEST((fs::exists(docs / image) || std::ranges::find(made, image) != made.end()),
                 page.string() + " shows " + image + ", which no command makes");
    }
  }
}

// A page with commands and a picture; a command that is hidden from the reader copies the picture into place.
BOOST_AUTO_TEST_CASE(pages_make_their_own_pictures) {
  const TemporaryDirectory directory;
  const fs::path docs = directory / "docs";
  fs::create_directories(docs / "scenes");
  fs::create_directories(docs / "sub");
  write_text(docs / "scenes/small.toml", quick_scene("0.5"));
  write_text(docs / "sub/page.md",
             "```sh\ncmake --build nowhere\nbuild/vehd run docs/scenes/small.toml -o out/small\n```\n"
             "<!-- sh: cp out/small/plots/shapes.png docs/images/small.png -->\n![small](../images/small.png)\n");
  write_text(docs / "wrong.md",
             "```sh\nbuild/vehd plot nowhere\n```\n<!-- sh: cp nowhere docs/images/never.png -->\n"
             "```text\n<!-- sh: touch docs/images/no_command.png\n```\n");
  write_text(docs / "other.md", "```sh\ntouch docs/other_page_was_run\n```\n");
  const ProgramResult result =
      run_vehd({"bench", "all", "--only", "pages", "--docs", docs.string(), "-o", directory / "out"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  BOOST_TEST(file_text(docs / "images/small.png").substr(1, 3) == "PNG");
  BOOST_TEST(result.output.find("without pictures of wrong.md") != std::string::npos, result.output);
  BOOST_TEST(result.errors.find("build/vehd plot nowhere: nowhere: holds no run") != std::string::npos, result.errors);
  BOOST_TEST(!fs::exists(docs / "other_page_was_run"));
  BOOST_TEST(std::distance(fs::directory_iterator(docs / "images"), {}) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
