#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/app/reference_run.hpp"

namespace {

/// A run in a field with seven snapshots.
struct PlottedRun : FinishedRun {
  PlottedRun() : FinishedRun(quick_scene("3.0")) {}

  [[nodiscard]] ProgramResult plot(std::vector<std::string> options) const {
    options.insert(options.begin(), {"plot", output, "--json", directory / "plot.json"});
    return run_vehd(options);
  }
};

struct Word {
  std::string text;
  double left, top, right, bottom;
};

/// Words of a PDF with the boxes of their letters.
std::vector<Word> words_with_places(const std::string& pdf) {
  const ProgramResult result = run_command({"pdftotext", "-bbox", pdf, "-"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const std::regex pattern("<word xMin=\"([^\"]+)\" yMin=\"([^\"]+)\" xMax=\"([^\"]+)\" yMax=\"([^\"]+)\">([^<]*)<");
  std::vector<Word> words;
  for (std::sregex_iterator word(result.output.begin(), result.output.end(), pattern), end; word != end; ++word) {
    words.push_back(
        {(*word)[5], std::stod((*word)[1]), std::stod((*word)[2]), std::stod((*word)[3]), std::stod((*word)[4])});
  }
  return words;
}

/// Letters fill their boxes to about three quarters of the height.
bool overlap(const Word& a, const Word& b) {
  const double slack = 0.15 * std::min(a.bottom - a.top, b.bottom - b.top);
  return a.left + 0.1 < b.right && b.left + 0.1 < a.right && a.top + slack < b.bottom - slack &&
         b.top + slack < a.bottom - slack;
}

bool has_word(const std::vector<Word>& words, const std::string& text) {
  return std::ranges::any_of(words, [&](const Word& word) { return word.text == text; });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plot, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_FIXTURE_TEST_CASE(no_word_of_a_picture_lies_over_another, PlottedRun) {
  for (const auto& options : std::vector<std::vector<std::string>>{
           {}, {"--field", "tension", "--section"}, {"--field", "none", "--view", "x", "--times", "0,3"}}) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--format", "pdf", "-o", directory / "pdf"});
    const ProgramResult result = plot(all);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    for (const char* file : {"pdf/shapes.pdf", "pdf/history.pdf"}) {
      const std::vector<Word> words = words_with_places(directory / file);
      BOOST_TEST(words.size() > 5, file);
      for (std::size_t i = 0; i < words.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          BOOST_TEST(!overlap(words[i], words[k]), words[i].text + " over " + words[k].text + " in " + file);
        }
      }
    }
    const std::vector<Word> words = words_with_places(directory / "pdf/shapes.pdf");
    BOOST_TEST(has_word(words, "field"));
    BOOST_TEST(has_word(words, "z"));
    BOOST_TEST(has_word(words, "t"));
  }
}

BOOST_FIXTURE_TEST_CASE(files_are_of_the_requested_kind, PlottedRun) {
  BOOST_TEST(plot({"-o", directory / "one/shape.svg"}).exit_code == 0);
  const std::string svg = directory / "one/shape.svg";
  const ProgramResult parsed = run_command(
      {"python3", "-c", "import sys, xml.etree.ElementTree as t; print(t.parse(sys.argv[1]).getroot().tag)", svg});
  BOOST_TEST(parsed.exit_code == 0, parsed.errors);
  BOOST_TEST(parsed.output == "{http://www.w3.org/2000/svg}svg\n");
  // The run is the only entry of its folder: pictures are within it, not beside it.
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(directory / "one"), {}) == 1);
  BOOST_TEST(file_text(svg).find("data:image/png;base64") != std::string::npos);

  BOOST_TEST(plot({"-o", directory / "one/shape.pdf"}).exit_code == 0);
  BOOST_TEST(file_text(directory / "one/shape.pdf").starts_with("%PDF-"));
  BOOST_TEST(run_command({"pdfinfo", directory / "one/shape.pdf"}).output.find("Pages:           1") !=
             std::string::npos);
  BOOST_TEST(plot({"-o", directory / "many", "--format", "svg"}).exit_code == 0);
  BOOST_TEST(std::filesystem::exists(directory / "many/history.svg"));

  const ProgramResult both = plot({"-o", directory / "one/shape.pdf", "--format", "png"});
  BOOST_TEST(both.exit_code == 1);
  BOOST_TEST(both.errors.find("--format png") != std::string::npos, both.errors);
}

BOOST_FIXTURE_TEST_CASE(times_are_chosen_from_the_first_to_the_last, PlottedRun) {
  BOOST_TEST(plot({"-o", directory / "shapes.png"}).exit_code == 0);
  const auto times = json_of(directory / "plot.json").at("times").get<std::vector<double>>();
  BOOST_TEST(times.size() >= 3u);
  BOOST_TEST(times.front() == 0.0);
  BOOST_TEST(times.back() == 3.0);
  BOOST_TEST(std::ranges::is_sorted(times));
}

BOOST_FIXTURE_TEST_CASE(every_field_and_view_is_drawn_and_others_are_refused, PlottedRun) {
  for (const char* field : {"V_m", "q", "tension", "force", "curvature", "none"}) {
    const ProgramResult result =
        plot({"-o", directory / "shapes.png", "--field", field, "--view", "1,-1,0.5", "--times", "3"});
    BOOST_TEST(result.exit_code == 0, field + result.errors);
  }
  const ProgramResult view = plot({"--view", "sideways"});
  BOOST_TEST(view.exit_code == 1);
  BOOST_TEST(view.errors.find("accepted: x, y, z") != std::string::npos, view.errors);
  BOOST_TEST(plot({"--field", "colour"}).exit_code == 1);
}

// Seen along its normal a wall has no edge to draw.
BOOST_AUTO_TEST_CASE(a_wall_seen_edge_on_is_a_line_below_the_vesicle) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml",
             "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.3]\ncentre = [0.0, 0.0, 1.7]\n"
             "[membrane]\nbending_modulus = 0.1\n[wall]\nnormal = [0.0, 0.0, 1.0]\nflow = \"no-slip\"\n"
             "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.1\n");
  BOOST_TEST_REQUIRE(run_vehd({"run", directory / "scene.toml", "-o", directory / "out", "--no-plot"}).exit_code == 0);
  const std::regex of_wall("stroke='rgb\\( 96,  96,  96\\)' *d='M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+) ");
  const std::regex of_image("<image x='[^']+' y='([0-9.]+)' width='([0-9.]+)' height='([0-9.]+)'");
  for (const char* view : {"y", "z"}) {
    const ProgramResult result =
        run_vehd({"plot", directory / "out", "--times", "0", "--view", view, "-o", directory / "shapes.svg"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    const std::string svg = file_text(directory / "shapes.svg");
    std::smatch wall, image;
    BOOST_TEST_REQUIRE(std::regex_search(svg, wall, of_wall) == (*view == 'y'));
    if (*view == 'z') continue;
    BOOST_TEST_REQUIRE(std::regex_search(svg, image, of_image));
    const double half_height = 0.5 * std::stod(image[3]), middle = std::stod(image[1]) + half_height;
    BOOST_TEST(wall[2] == wall[4]);
    BOOST_TEST(std::abs(std::stod(wall[3]) - std::stod(wall[1]) - std::stod(image[2])) < 0.1);
    // The middle of the vesicle is 1.7 above the wall, and the picture reaches a little further.
    BOOST_TEST(std::stod(wall[2]) - middle > 0.9 * half_height);
    BOOST_TEST(std::stod(wall[2]) - middle < half_height);
  }
}

BOOST_AUTO_TEST_CASE(a_missing_field_is_named_with_those_present) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml",
             "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.3]\n[membrane]\nbending_modulus = 0.1\n"
             "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.2\n");
  BOOST_TEST_REQUIRE(run_vehd({"run", directory / "scene.toml", "-o", directory / "out", "--no-plot"}).exit_code == 0);
  const ProgramResult result = run_vehd({"plot", directory / "out", "--field", "V_m"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.find("accepted: none, tension, force, curvature") != std::string::npos, result.errors);
  // Electric columns of the history are nan or absent; the other panels are drawn.
  BOOST_TEST(run_vehd({"plot", directory / "out"}).exit_code == 0);
  BOOST_TEST(std::filesystem::exists(directory / "out/plots/history.png"));
}

BOOST_AUTO_TEST_SUITE_END()
