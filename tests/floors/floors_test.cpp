#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <map>

#include "tests/floors/source_files.hpp"

namespace {

namespace fs = std::filesystem;

/// A module includes and links only modules of lower floors; modules of one floor are independent of each other.
const std::map<std::string, int> floors = {{"support", 0},    {"mpi", 1},      {"sphere", 1},     {"kernels", 1},
                                           {"linear", 1},     {"geometry", 2}, {"potentials", 3}, {"physics", 4},
                                           {"stepping", 5},   {"files", 6},    {"scene", 7},      {"runs", 8},
                                           {"estimate", 9},   {"pictures", 9}, {"bench", 10},     {"fit", 10},
                                           {"comparison", 9}, {"app", 11},     {"python", 11}};

bool may_use(const std::string& module, const std::string& other) {
  if (module == other) return true;
  return floors.contains(module) && floors.contains(other) && floors.at(other) < floors.at(module);
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Source files below the given folders.
std::vector<fs::path> code_below(const std::vector<std::string>& folders) {
  std::vector<fs::path> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".cpp" || ending == ".hpp") files.push_back(fs::relative(entry.path(), source));
    }
  }
  return files;
}

std::string module_of(const fs::path& file) { return (++file.begin())->string(); }

/// The path in an #include of the module that violates the floors; empty if there is none.
std::string wrong_include(const std::string& module, const std::string& line) {
  static const std::regex include("\\s*#\\s*include\\s*[\"<]([^\">]+)[\">].*");
  std::smatch match;
  if (!std::regex_match(line, match, include)) return "";
  const std::string path = match[1];
  static const std::regex room("bie/([a-z_]+)/.*");
  if (std::regex_match(path, match, room)) return may_use(module, match[1]) ? "" : path;
  // A relative path would bypass the floors; the finite elements are no part of the solver.
  const bool wrong = path.find("..") != std::string::npos || path.starts_with("bie/") ||
                     path.starts_with("fem_check/") || path.starts_with("meshes/") || path.starts_with("tests/");
  return wrong ? path : "";
}

/// Libraries that a line of bie/CMakeLists.txt links to a module in violation of the floors.
std::vector<std::string> wrong_links(const std::string& line) {
  static const std::regex module("\\s*(vehd_module\\(|target_link_libraries\\(vehd_)([a-z_]+)(.*)");
  static const std::regex library("vehd_([a-z_]+)");
  std::smatch match;
  std::vector<std::string> wrong;
  if (!std::regex_match(line, match, module) || !floors.contains(match[2])) return wrong;
  const std::string name = match[2], rest = match[3];
  for (std::sregex_iterator it(rest.begin(), rest.end(), library), end; it != end; ++it) {
    const std::string other = (*it)[1];
    if (floors.contains(other) && (other == name || !may_use(name, other))) wrong.push_back(other);
  }
  return wrong;
}

bool prints(const std::string& line) {
  static const std::regex print("fmt::print\\(|spdlog|std::c(out|err)\\b|\\bf?printf\\(|\\bf?puts\\(");
  return std::regex_search(line, print);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(floors_of_modules)

BOOST_AUTO_TEST_CASE(every_folder_is_a_module_with_a_floor) {
  std::size_t n_modules = 0;
  for (const auto& entry : fs::directory_iterator(source / "bie")) {
    // Modules hold code; bie/cmake holds none.
    if (!entry.is_directory() || entry.path().filename() == "cmake") continue;
    BOOST_TEST(floors.contains(entry.path().filename().string()), entry.path().string());
    ++n_modules;
  }
  BOOST_TEST(n_modules == floors.size());
}

BOOST_AUTO_TEST_CASE(no_module_includes_one_of_its_own_floor_or_above) {
  const std::vector<fs::path> files = code_below({"bie"});
  BOOST_TEST(files.size() > 300);
  for (const fs::path& file : files) {
    for (const std::string& line : lines_of(source / file)) {
      const std::string wrong = wrong_include(module_of(file), line);
      BOOST_TEST(wrong.empty(), file.string() + " includes " + wrong);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_module_links_one_of_its_own_floor_or_above) {
  for (const std::string& line : lines_of(source / "bie/CMakeLists.txt")) {
    for (const std::string& wrong : wrong_links(line)) BOOST_TEST(false, line + ": " + wrong);
  }
}

BOOST_AUTO_TEST_CASE(wrong_includes_and_links_are_seen) {
  BOOST_TEST(wrong_include("files", "#include \"bie/scene/scene.hpp\"") == "bie/scene/scene.hpp");
  BOOST_TEST(wrong_include("estimate", "#include \"bie/pictures/plots.hpp\"") == "bie/pictures/plots.hpp");
  BOOST_TEST(wrong_include("kernels", "# include <bie/linear/recycled_gcr.hpp>") == "bie/linear/recycled_gcr.hpp");
  BOOST_TEST(wrong_include("app", "#include \"../scene/scene.hpp\"") == "../scene/scene.hpp");
  BOOST_TEST(wrong_include("comparison", "#include \"fem_check/flow.hpp\"") == "fem_check/flow.hpp");
  BOOST_TEST(wrong_include("scene", "#include \"bie/cellar/wine.hpp\"") == "bie/cellar/wine.hpp");
  BOOST_TEST(wrong_include("scene", "#include \"bie/files/run_reader.hpp\"").empty());
  BOOST_TEST(wrong_include("scene", "#include \"bie/scene/scene.hpp\"").empty());
  BOOST_TEST(wrong_include("scene", "#include <vector>").empty());
  BOOST_TEST(wrong_links("vehd_module(runs vehd_scene)").empty());
  BOOST_TEST(wrong_links("vehd_module(runs vehd_scene vehd_bench)") == std::vector<std::string>{"bench"},
             boost::test_tools::per_element());
  BOOST_TEST(wrong_links("target_link_libraries(vehd_pictures PUBLIC vehd_comparison)") ==
                 std::vector<std::string>{"comparison"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(commands_print_and_nothing_else_does) {
  int n_printing = 0;
  for (const fs::path& file : code_below({"bie"})) {
    // The progress line is drawn on its own floor; the check of the processor runs before everything else.
    const bool may_print = module_of(file) == "app" || file == "bie/support/progress.cpp" ||
                           file.string().starts_with("bie/support/processor/");
    for (const std::string& line : lines_of(source / file)) {
      if (!prints(line)) continue;
      ++n_printing;
      BOOST_TEST(may_print, file.string() + ": " + line);
    }
  }
  BOOST_TEST(n_printing > 10);
}

BOOST_AUTO_TEST_CASE(no_file_is_longer_than_four_hundred_lines) {
  constexpr std::size_t most = 400;
  for (const fs::path& file : code_below({"bie", "fem_check", "meshes", "tests"})) {
    const std::size_t n_lines = lines_of(source / file).size();
    BOOST_TEST(n_lines <= most, file.string() + ": " + std::to_string(n_lines) + " lines");
  }
}

BOOST_AUTO_TEST_SUITE_END()
