#include <boost/test/unit_test.hpp>
#include <regex>

#include "bie/bench/pages.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {fs::path(VEHD_SOURCE_DIR) / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Python modules that a command needs.
std::string modules_of(const std::string& command) {
  if (!command.starts_with("python3 ")) return "";
  return command.find("report_page.py") == std::string::npos ? "h5py, numpy, matplotlib" : "selenium";
}

bool is_installed(const std::string& program) {
  return run_command({"sh", "-c", "command -v " + program}).exit_code == 0;
}

/// The command with little to compute: this test checks that it works, not its figures.
std::string shortened(std::string command) {
  command = std::regex_replace(command, std::regex("--(degrees|orders) [0-9,]+"), "--$1 6,8");
  command = std::regex_replace(command, std::regex("--degree [0-9]+"), "--degree 6");
  command = std::regex_replace(command, std::regex("--repeats [0-9]+"), "--repeats 1");
  command = std::regex_replace(command, std::regex("--dt [0-9.,]+"), "--dt 0.1,0.05,0.025");
  command = std::regex_replace(command, std::regex("--tolerance [0-9e.,-]+"), "--tolerance 1e-1,1e-2");
  command = std::regex_replace(command, std::regex("--(at|time) [0-9.]+"), "--$1 0.3");
  command = std::regex_replace(command, std::regex("--times [0-9.,]+"), "--times 0,0.1,0.3");
  command = std::regex_replace(command, std::regex("--times \"[^\"]+\""), "--times \"0, 1 us\"");
  // At such a degree both methods' errors are large, above all that of the bending force.
  command = std::regex_replace(command, std::regex("vehd check"), "vehd check --require 1");
  if (command.starts_with("python3 ")) command.replace(0, 7, python_with(modules_of(command)));
  command = std::regex_replace(command, std::regex("bench (all|methods|stability)"), "bench $1 --quick");
  // The suite `bench` runs all of it.
  return std::regex_replace(command, std::regex("bench all"), "bench all --only space");
}

/// The command without the pictures of its run, unless another command of the page reads them.
std::string without_unread_pictures(const std::string& command, const std::string& page) {
  std::smatch scene, folder;
  if (!std::regex_search(command, scene, std::regex("vehd run (\\S+/)?(\\w+)\\.toml"))) return command;
  if (command.find("--no-plot") != std::string::npos) return command;
  const bool is_named = std::regex_search(command, folder, std::regex(" -o (\\S+)"));
  const std::string output = is_named ? folder[1].str() : "out/" + scene[2].str();
  return page.find(output + "/plots/") == std::string::npos ? command + " --no-plot" : command;
}

bool needs_finite_elements(const std::string& command) {
  return std::regex_search(command, std::regex("vehd (bench methods|check|mesh)")) && !finite_elements_are_built();
}

/// The suites `methods` and `movie` run these commands and check their results.
bool another_suite_runs(const std::string& command) {
  return command == "build/vehd bench methods" || command.ends_with(" --movie");
}

/// A program or module that a command of a page needs and this machine lacks; empty if nothing is missing.
std::string missing_program(const std::string& command) {
  const std::string modules = modules_of(command);
  if (modules == "selenium" && !(is_installed("chromium") && is_installed("chromedriver"))) return "chromium";
  return !modules.empty() && python_with(modules).empty() ? modules : "";
}

/// A sweep with few runs, each of few vesicles.
std::string few_runs(std::string sweep) {
  sweep = std::regex_replace(sweep, std::regex("(\\[suspension\\]\nkind = \"ball\"\nradius = )[0-9.]+"), "$015.0");
  return std::regex_replace(sweep, std::regex("count = [0-9]+"), "count = 2");
}

/// A folder laid out like the source tree, as a reader of the pages has it.
struct ReaderFolder {
  TemporaryDirectory directory;

  ReaderFolder() {
    fs::create_directories(directory / "build");
    fs::create_symlink(VEHD_PROGRAM, directory / "build/vehd");
    for (const char* folder : {"docs/scenes", "docs/examples", "docs/sweeps"}) {
      fs::create_directories(directory / folder);
      for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / folder)) {
        const fs::path copy = fs::path(directory / folder) / entry.path().filename();
        if (entry.path().extension() == ".toml") write_text(copy, few_runs(shortened_scene(file_text(entry.path()))));
        if (entry.path().extension() == ".py" || entry.path().extension() == ".csv") fs::copy_file(entry.path(), copy);
      }
    }
    // These are quick, and shortened data would not determine the parameters that the page fits.
    fs::copy(fs::path(VEHD_SOURCE_DIR) / "docs/fits", directory / "docs/fits");
    fs::copy(fs::path(VEHD_SOURCE_DIR) / "docs/notebooks", directory / "docs/notebooks");
    copy_some_hard_cases(directory / "");
    fs::create_directories(directory / "tests/app");
    fs::copy_file(VEHD_SOURCE_DIR "/tests/app/report_page.py", directory / "tests/app/report_page.py");
    fs::create_directories(directory / "docs/images");
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(documentation, *boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                         boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(every_shipped_scene_is_valid) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    BOOST_CHECK_NO_THROW(vehd::read_scene(entry.path()));
    ++count;
  }
  BOOST_TEST(count >= 6);
}

// A table renewed from only some of the scenes would lack the others.
BOOST_AUTO_TEST_CASE(every_shipped_scene_has_its_row_where_the_scenes_end) {
  const std::string page = file_text(VEHD_SOURCE_DIR "/docs/scenes.md");
  const std::size_t start = page.find("<!-- table scenes -->");
  const std::string table = page.substr(start, page.find("<!-- end of table -->", start) - start);
  for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename().string();
    BOOST_TEST(table.find("| " + name + " |") != std::string::npos, name);
  }
}

BOOST_AUTO_TEST_CASE(the_scene_of_the_tutorial_is_the_one_that_its_page_shows) {
  const std::string scene = file_text(VEHD_SOURCE_DIR "/docs/examples/tutorial.toml");
  BOOST_TEST(file_text(VEHD_SOURCE_DIR "/docs/tutorial.md").find("```toml\n" + scene + "```\n") != std::string::npos);
  BOOST_CHECK_NO_THROW(vehd::read_scene(VEHD_SOURCE_DIR "/docs/examples/tutorial.toml"));
}

BOOST_AUTO_TEST_CASE(every_command_of_every_page_works) {
  int count = 0;
  for (const fs::path& page : pages()) {
    // Each page starts in a new folder, as its reader does.
    const ReaderFolder folder;
    const std::string text = file_text(page);
    std::vector<std::string> done;
    bool all_are_done = true;
    for (const std::string& written : vehd::commands_of_page(page)) {
      if (needs_finite_elements(written) || another_suite_runs(written)) continue;
      if (const std::string missing = missing_program(written); !missing.empty()) {
        BOOST_TEST_MESSAGE("skipped: " + written + ": " + missing + " is missing");
        all_are_done = false;
        continue;
      }
      // The file to be copied may be missing because a command was skipped.
      if (!all_are_done && written.starts_with("cp ")) continue;
      const std::string command = without_unread_pictures(shortened(written), text);
      const ProgramResult result = run_command({"sh", "-c", "cd '" + (folder.directory / "") + "' && " + command});
      BOOST_TEST(result.exit_code == 0, page.string() + ": " + command + "\n" + result.errors);
      done.push_back(written);
      ++count;
    }
    for (const std::string& picture : vehd::pictures_of(done)) {
      BOOST_TEST(fs::exists(folder.directory / ("docs/" + picture)), page.string() + " makes no " + picture);
    }
  }
  BOOST_TEST(count >= 4);
}

BOOST_AUTO_TEST_SUITE_END()
