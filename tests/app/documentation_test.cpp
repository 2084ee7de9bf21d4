#include <boost/test/unit_test.hpp>
#include <regex>
#include <sstream>

#include "bie/scene/reader.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

/// Lines of the ```sh blocks of a page. Commands that install, fetch or build are what runs this test, and what is
/// installed is tested by tests/installed.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  std::istringstream text(file_text(page));
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside && !line.empty() && !line.starts_with("#") &&
               !std::regex_search(line, std::regex("^(git |cmake |ctest |apt-get |dpkg |out/(installed|package)/)"))) {
      commands.push_back(line);
    }
  }
  return commands;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {fs::path(VEHD_SOURCE_DIR) / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The command with little to measure: that it works is under test here, not its figures.
std::string shortened(std::string command) {
  command = std::regex_replace(command, std::regex("--degrees [0-9,]+"), "--degrees 6,8");
  command = std::regex_replace(command, std::regex("--degree [0-9]+"), "--degree 6");
  command = std::regex_replace(command, std::regex("--repeats [0-9]+"), "--repeats 1");
  command = std::regex_replace(command, std::regex("--dt [0-9.,]+"), "--dt 0.1,0.05,0.025");
  command = std::regex_replace(command, std::regex("--tolerance [0-9e.,-]+"), "--tolerance 1e-1,1e-2");
  command = std::regex_replace(command, std::regex("--(at|time) [0-9.]+"), "--$1 0.3");
  command = std::regex_replace(command, std::regex("--times [0-9.,]+"), "--times 0,0.1,0.3");
  if (command.starts_with("python3 ")) command.replace(0, 7, python_with("h5py, numpy, matplotlib"));
  command = std::regex_replace(command, std::regex("bench (all|methods|stability)"), "bench $1 --quick");
  // The suite `bench` runs all of it.
  return std::regex_replace(command, std::regex("bench all"), "bench all --only space");
}

bool needs_finite_elements(const std::string& command) {
  return std::regex_search(command, std::regex("vehd (bench methods|check|mesh)")) && !finite_elements_are_built();
}

/// What a command of a page needs and this machine does not have; empty if it has all.
std::string missing_program(const std::string& command) {
  if (command.find("--movie") != std::string::npos && run_command({"sh", "-c", "command -v ffmpeg"}).exit_code != 0) {
    return "ffmpeg";
  }
  const bool is_python = command.starts_with("python3 ");
  return is_python && python_with("h5py, numpy, matplotlib").empty() ? "h5py, numpy or matplotlib" : "";
}

/// A folder that looks like the source tree to a reader of the pages.
struct ReaderFolder {
  TemporaryDirectory directory;

  ReaderFolder() {
    fs::create_directories(directory / "build");
    fs::create_symlink(VEHD_PROGRAM, directory / "build/vehd");
    for (const char* folder : {"docs/scenes", "docs/examples"}) {
      fs::create_directories(directory / folder);
      for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / folder)) {
        const fs::path copy = fs::path(directory / folder) / entry.path().filename();
        if (entry.path().extension() == ".toml") write_text(copy, shortened_scene(file_text(entry.path())));
        if (entry.path().extension() == ".py") fs::copy_file(entry.path(), copy);
      }
    }
    copy_some_hard_cases(directory / "");
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(documentation, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(every_shipped_scene_is_valid) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    BOOST_CHECK_NO_THROW(vehd::read_scene(entry.path()));
    ++count;
  }
  BOOST_TEST(count >= 6);
}

// A table that was renewed from a part of the scenes would tell of that part alone.
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
  const OwnCache cache;
  for (const fs::path& page : pages()) {
    // Each page starts afresh, as its reader does.
    const ReaderFolder folder;
    for (const std::string& written : commands_of(page)) {
      if (needs_finite_elements(written)) continue;
      if (const std::string missing = missing_program(written); !missing.empty()) {
        BOOST_TEST_MESSAGE("skipped: " + written + ": " + missing + " is missing");
        continue;
      }
      const std::string command = shortened(written);
      const ProgramResult result = run_command({"sh", "-c", "cd '" + (folder.directory / "") + "' && " + command});
      BOOST_TEST(result.exit_code == 0, page.string() + ": " + command + "\n" + result.errors);
      ++count;
    }
  }
  BOOST_TEST(count >= 4);
}

BOOST_AUTO_TEST_SUITE_END()
