#include <boost/test/unit_test.hpp>
#include <regex>
#include <sstream>

#include "bie/scene/reader.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

/// Lines of the ```sh blocks of a page. Commands that install, fetch or build are what runs this test.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  std::istringstream text(file_text(page));
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside && !line.empty() && !line.starts_with("#") &&
               !std::regex_search(line, std::regex("^(git|cmake|ctest) "))) {
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

/// The scene at a low order and with few steps: the commands are under test here, not the physics.
std::string shortened(std::string scene) {
  scene = std::regex_replace(scene, std::regex("order = \\d+"), "order = 6");
  scene = std::regex_replace(scene, std::regex("\ndt = [0-9.e-]+"), "\ndt = 0.1");
  scene = std::regex_replace(scene, std::regex("\nend_time = [0-9.e-]+"), "\nend_time = 0.3");
  return std::regex_replace(scene, std::regex("\nevery = [0-9.e-]+"), "\nevery = 0.1");
}

/// A folder that looks like the source tree to a reader of the pages.
struct ReaderFolder {
  TemporaryDirectory directory;

  ReaderFolder() {
    fs::create_directories(directory / "build");
    fs::create_symlink(VEHD_PROGRAM, directory / "build/vehd");
    fs::create_directories(directory / "docs/scenes");
    for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs/scenes")) {
      if (entry.path().extension() != ".toml") continue;
      write_text(directory / ("docs/scenes/" + entry.path().filename().string()), shortened(file_text(entry.path())));
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(documentation)

BOOST_AUTO_TEST_CASE(every_shipped_scene_is_valid) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(VEHD_SOURCE_DIR) / "docs/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    BOOST_CHECK_NO_THROW(vehd::read_scene(entry.path()));
    ++count;
  }
  BOOST_TEST(count >= 6);
}

BOOST_AUTO_TEST_CASE(every_command_of_every_page_works) {
  int count = 0;
  for (const fs::path& page : pages()) {
    // Each page starts afresh, as its reader does.
    const ReaderFolder folder;
    for (const std::string& command : commands_of(page)) {
      const ProgramResult result = run_command({"sh", "-c", "cd '" + (folder.directory / "") + "' && " + command});
      BOOST_TEST(result.exit_code == 0, page.string() + ": " + command + "\n" + result.errors);
      ++count;
    }
  }
  BOOST_TEST(count >= 4);
}

BOOST_AUTO_TEST_SUITE_END()
