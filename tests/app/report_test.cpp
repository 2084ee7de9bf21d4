#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "tests/app/program.hpp"

namespace {

/// Whether there are a browser and its driver; the set-up for tests installs them, a manual build may lack them.
bool can_browse(const std::string& python) {
  const bool available =
      !python.empty() && run_command({"sh", "-c", "command -v chromium && command -v chromedriver"}).exit_code == 0;
  if (!available) {
    BOOST_TEST_MESSAGE(
        "skipped: chromium, chromedriver or selenium (Debian packages chromium, chromium-driver, python3-selenium) is "
        "missing");
  }
  return available;
}

/// Data that the page holds for its scripts.
nlohmann::json data_of(const std::string& page) {
  const std::string start = "<script type=\"application/json\" id=\"run\">";
  const std::size_t begin = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// A run and its report.
struct ReportedRun {
  TemporaryDirectory directory;
  std::string output = directory / "a <run>";
  std::string page = output + "/report.html";

  explicit ReportedRun(const std::string& scene) {
    write_text(directory / "scene.toml", scene);
    const ProgramResult run = run_vehd({"run", directory / "scene.toml", "-o", output, "--no-plot"});
    BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
    const ProgramResult report = run_vehd({"report", output, "--json", directory / "report.json"});
    BOOST_TEST_REQUIRE(report.exit_code == 0, report.errors);
  }

  /// Content of the page as a browser shows it.
  [[nodiscard]] nlohmann::json shown(const std::string& python) const {
    const ProgramResult result =
        run_command({python, std::string(VEHD_SOURCE_DIR) + "/tests/app/report_page.py", page});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    return nlohmann::json::parse(result.output);
  }
};

/// Largest relative difference between the drawn extents and those of a row of the history.
double wrong_extents(const nlohmann::json& state, const vehd::HistoryTable& history, std::size_t row) {
  double worst = 0.0;
  const std::vector<std::string> columns = {"extent_x", "extent_y", "extent_z"};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double extent = history.column(columns[i])[row];
    worst = std::max(worst, std::abs(state["extents"][i].get<double>() - extent) / extent);
  }
  return worst;
}

/// A scene with only bending, in which only the tension can be shown in colour.
std::string scene_without_field() {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.2, 1.5]\n[membrane]\nbending_modulus = 0.1\n"
         "[numerics]\norder = 6\ndt = 0.25\nend_time = 1.0\n[output]\nevery = 0.5\n";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(report, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(page_is_self_contained_and_describes_the_run) {
  const ReportedRun run(quick_scene());
  const std::string page = file_text(run.page);
  for (const char* outside : {"<link", "<script src", "<img src=\"http", "@import", "url("}) {
    BOOST_TEST(page.find(outside) == std::string::npos, outside);
  }
  BOOST_TEST(page.find("{{") == std::string::npos);
  BOOST_TEST(page.find("<title>a &lt;run></title>") != std::string::npos);
  const nlohmann::json data = data_of(page), summary = json_of(run.output + "/summary.json");
  BOOST_TEST(data["verdict"]["text"] == summary["verdict"]);
  const auto& limits = data["verdict"]["limits"];
  const auto strain = std::ranges::find_if(limits, [](const auto& row) { return row["name"] == "strain_max"; });
  BOOST_TEST_REQUIRE((strain != limits.end()));
  BOOST_TEST(std::abs((*strain)["worst"].get<double>() / summary["strain_max"].get<double>() - 1.0) < 1e-5);
  BOOST_TEST(data["scene"]["text"] == file_text(run.output + "/scene.toml"));
  BOOST_TEST(data["surface"]["times"].size() == 7);
  BOOST_TEST(data["surface"]["fields"].size() == 3);
  const nlohmann::json result = json_of(run.directory / "report.json");
  BOOST_TEST(result["bytes"].get<std::size_t>() == page.size());
  BOOST_TEST(result["snapshots"] == 7);
  BOOST_TEST(page.size() < 200'000);
}

BOOST_AUTO_TEST_CASE(report_of_a_run_in_si_is_in_its_units) {
  const ReportedRun run(
      "[units]\nlength = \"10 um\"\ntime = \"10 us\"\n"
      "[shape]\nkind = \"ellipsoid\"\naxes = [\"9 um\", \"9 um\", \"12 um\"]\n"
      "[membrane]\nbending_modulus = \"1e-19 J\"\ncapacitance = \"10 mF/m^2\"\n[fluid]\nviscosity = \"1 mPa s\"\n"
      "[electric]\nfield = [0, 0, \"0.3 kV/cm\"]\nconductivity_in = \"0.5 mS/cm\"\nconductivity_out = \"1 mS/cm\"\n"
      "permittivity = \"80 eps0\"\n"
      "[numerics]\norder = 6\ndt = \"25 us\"\nend_time = \"150 us\"\n[output]\nevery = \"75 us\"\n");
  const nlohmann::json data = data_of(file_text(run.page));
  const auto& reached = data["facts"][0];
  BOOST_TEST(reached[0] == "time reached");
  BOOST_TEST(reached[1] == "0.15 ms");
  BOOST_TEST(data["surface"]["unit"] == "µm");
  BOOST_TEST(data["surface"]["times"] == nlohmann::json::parse("[0.0, 0.075, 0.15]"));
  BOOST_TEST(std::abs(data["surface"]["extents"][0][2].get<double>() - 24.0) < 1e-4);
  BOOST_TEST(data["surface"]["fields"][0]["unit"] == "mV");
  BOOST_TEST(data["history"]["unit"] == "ms");
  std::map<std::string, std::string> units;
  for (const auto& panel : data["history"]["panels"]) units[panel["title"]] = panel["unit"];
  BOOST_TEST(units.at("potential across the membrane") == "mV");
  BOOST_TEST(units.at("extent") == "µm");
  BOOST_TEST(units.at("aspect ratio") == "");
  // The unit of a panel is that of its column of history.csv.
  const vehd::HistoryTable history(run.output + "/history.csv");
  BOOST_TEST(units.at("charge density") == vehd::printed_unit(history.unit("q_north")));
}

BOOST_AUTO_TEST_CASE(wall_is_below_the_vesicle) {
  const ReportedRun run(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.2]\ncentre = [0.5, 0.0, 1.5]\n"
      "[membrane]\nbending_modulus = 0.1\n[wall]\nnormal = [0, 0, 2]\nflow = \"no-slip\"\n"
      "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.1\n");
  const nlohmann::json wall = data_of(file_text(run.page))["surface"]["wall"];
  BOOST_TEST(wall["normal"] == nlohmann::json::parse("[0.0, 0.0, 1.0]"));
  BOOST_TEST_REQUIRE(wall["heights"].size() == 2);
  BOOST_TEST(std::abs(wall["heights"][0].get<double>() - 1.5) < 1e-5);
  const std::string python = python_with("selenium");
  if (!can_browse(python)) return;
  const nlohmann::json shown = run.shown(python);
  BOOST_TEST(shown["errors"].empty(), shown["errors"].dump());
  // The square is four radii of the farthest point wide, and reaches down to the wall.
  const double reach = data_of(file_text(run.page))["surface"]["radius"].get<double>();
  const auto extents = shown["start"]["extents"].get<std::vector<double>>();
  BOOST_TEST(std::abs(extents[0] / (4.0 * reach) - 1.0) < 1e-5);
  BOOST_TEST(std::abs(extents[2] / (1.5 + 1.2) - 1.0) < 1e-2);
}

BOOST_AUTO_TEST_CASE(long_runs_are_thinned_out_with_their_first_and_last_snapshot) {
  const ReportedRun run(quick_scene());
  const std::string page = run.directory / "a folder/of its own/page.html";
  const ProgramResult report =
      run_vehd({"report", run.output, "--snapshots", "3", "-o", page, "--json", run.directory / "short.json"});
  BOOST_TEST_REQUIRE(report.exit_code == 0, report.errors);
  const nlohmann::json result = json_of(run.directory / "short.json");
  BOOST_TEST(result["snapshots"] == 3);
  BOOST_TEST(result["snapshots_of_run"] == 7);
  const nlohmann::json surface = data_of(file_text(page))["surface"];
  BOOST_TEST(surface["times"] == nlohmann::json::parse("[0.0, 1.5, 3.0]"));
}

BOOST_AUTO_TEST_CASE(run_under_way_says_so) {
  const ReportedRun run(scene_without_field());
  std::filesystem::remove(run.output + "/summary.json");
  BOOST_TEST(run_vehd({"report", run.output}).exit_code == 0);
  const nlohmann::json verdict = data_of(file_text(run.page))["verdict"];
  BOOST_TEST(verdict["state"] == "unfinished");
  BOOST_TEST(verdict["text"].get<std::string>().starts_with("not finished"));
}

BOOST_AUTO_TEST_CASE(folder_without_a_run_is_refused) {
  const TemporaryDirectory directory;
  const ProgramResult result = run_vehd({"report", directory / "none"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == directory / "none" + ": holds no run (no run.h5)\n");
}

BOOST_AUTO_TEST_CASE(browser_shows_the_vesicle_and_the_slider_moves_it) {
  const std::string python = python_with("selenium");
  if (!can_browse(python)) return;
  const ReportedRun run(quick_scene());
  const nlohmann::json shown = run.shown(python);
  BOOST_TEST(shown["errors"].empty(), shown["errors"].dump());
  BOOST_TEST(shown["ready"] == "true");
  BOOST_TEST(shown["problem"] == "");
  BOOST_TEST(shown["title"] == "a <run>");
  BOOST_TEST(shown["verdict"] == json_of(run.output + "/summary.json")["verdict"]);
  BOOST_TEST(shown["fields"] == nlohmann::json::parse(R"(["V_m", "q", "tension λ", "none"])"));
  BOOST_TEST(shown["plots"].size() == 8, shown["plots"].dump());
  BOOST_TEST(shown["shapes"] == 6);
  BOOST_TEST(shown["wider_than_window"] == false);
  BOOST_TEST(shown["playing"] == "Pause");

  const nlohmann::json &start = shown["start"], &end = shown["end"];
  const double covered = start["pixels"]["covered"].get<double>();
  BOOST_TEST((covered > 0.1 && covered < 0.9), covered);
  BOOST_TEST(end["pixels"]["colours"].get<int>() > 200);
  BOOST_TEST(start["time"] == "t = 0");
  BOOST_TEST(end["time"] == "t = 3");
  BOOST_TEST(start["pixels"]["sum"] != end["pixels"]["sum"]);
  BOOST_TEST(end["pixels"]["sum"] != shown["turned"]["pixels"]["sum"]);
  BOOST_TEST(end["pixels"]["sum"] == shown["returned"]["pixels"]["sum"]);
  BOOST_TEST(end["pixels"]["sum"] != shown["recoloured"]["pixels"]["sum"]);
  BOOST_TEST(start["label"].get<std::string>().starts_with("Vesicle at t = 0, 2 by 2 by 3 along x, y and z"));

  // The scripts evaluate the same surface as the solver.
  const vehd::HistoryTable history(run.output + "/history.csv");
  BOOST_TEST(wrong_extents(start, history, 0) < 1e-3);
  BOOST_TEST(wrong_extents(end, history, history.n_rows() - 1) < 1e-3);
  const double Vm_max = history.column("Vm_max").back();
  BOOST_TEST(std::abs(end["values"][1].get<double>() / Vm_max - 1.0) < 2e-3);
}

BOOST_AUTO_TEST_CASE(browser_shows_runs_without_a_field) {
  const std::string python = python_with("selenium");
  if (!can_browse(python)) return;
  const ReportedRun run(scene_without_field());
  const nlohmann::json shown = run.shown(python);
  BOOST_TEST(shown["errors"].empty(), shown["errors"].dump());
  BOOST_TEST(shown["problem"] == "");
  BOOST_TEST(shown["fields"] == nlohmann::json::parse(R"(["tension λ", "none"])"));
  BOOST_TEST(shown["start"]["pixels"]["covered"].get<double>() > 0.1);
  BOOST_TEST(shown["start"]["pixels"]["sum"] != shown["end"]["pixels"]["sum"]);
  const vehd::HistoryTable history(run.output + "/history.csv");
  BOOST_TEST(wrong_extents(shown["start"], history, 0) < 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
