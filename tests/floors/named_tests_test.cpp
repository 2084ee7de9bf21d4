#include <boost/test/unit_test.hpp>
#include <map>

#include "tests/floors/source_files.hpp"

BOOST_AUTO_TEST_SUITE(named_tests)

namespace {

namespace fs = std::filesystem;

/// Cases of every suite; suites of one name in several programs count as one.
std::map<std::string, std::set<std::string>> suites() {
  std::map<std::string, std::set<std::string>> result;
  const std::regex line(
      R"(BOOST_(AUTO_TEST_SUITE|FIXTURE_TEST_SUITE|AUTO_TEST_CASE|FIXTURE_TEST_CASE|DATA_TEST_CASE)\(\s*(\w+))");
  for (const fs::path& file : files_below("tests", {".cpp"})) {
    const std::string text = text_of(file);
    std::string suite;
    for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) {
      if (it->str(1).ends_with("SUITE")) {
        suite = (*it)[2];
        result[suite];
      } else {
        result[suite].insert((*it)[2]);
      }
    }
  }
  return result;
}

/// @param name  SUITE, SUITE/CASE or SUITE/BEGINNING_OF_A_CASE*
bool exists(const std::map<std::string, std::set<std::string>>& suites, const std::string& name) {
  const std::size_t slash = name.find('/');
  const auto suite = suites.find(name.substr(0, slash));
  if (suite == suites.end()) return false;
  if (slash == std::string::npos) return true;
  std::string wanted = name.substr(slash + 1);
  if (!wanted.ends_with('*')) return suite->second.contains(wanted);
  wanted.pop_back();
  const auto next = suite->second.lower_bound(wanted);
  return next != suite->second.end() && next->starts_with(wanted);
}

/// Tests that a text names, as `SUITE/CASE` or with `--run_test=`. Names of cases are sentences: three words or more.
std::vector<std::string> tests_named_in(const std::string& text) {
  std::vector<std::string> names = found(text, R"(`([a-z0-9_]+/[a-z0-9]+(?:_[a-z0-9]+){2,})`)");
  const std::vector<std::string> whole = found(text, R"(`([a-z0-9_]+)/…`)");
  names.insert(names.end(), whole.begin(), whole.end());
  for (std::string list : found(text, R"(--run_test=([a-z][a-z0-9_,/*]*))")) {
    for (const std::string& name : found(list, "([^,]+)")) names.push_back(name);
  }
  return names;
}

std::vector<std::string> test_files_named_in(const std::string& text) {
  return found(text, R"((tests/[a-z0-9_/]+\.[ch]pp))");
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_test_that_a_page_names_exists) {
  const auto known = suites();
  std::size_t n_named = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& name : tests_named_in(text_of(page))) {
      BOOST_TEST(exists(known, name), page.string() + ": " + name);
      ++n_named;
    }
  }
  BOOST_TEST(n_named > 80);
}

BOOST_AUTO_TEST_CASE(every_file_of_tests_that_a_page_or_a_comment_names_exists) {
  std::size_t n_named = 0;
  for (const char* folder : {"docs", "bie", "fem_check", "meshes"}) {
    for (const fs::path& file : files_below(folder, {".md", ".hpp", ".cpp"})) {
      for (const std::string& name : test_files_named_in(text_of(file))) {
        BOOST_TEST(fs::exists(source / name), file.string() + ": " + name);
        ++n_named;
      }
    }
  }
  BOOST_TEST(n_named > 2);
}

BOOST_AUTO_TEST_CASE(missing_tests_are_seen) {
  const auto known = suites();
  const auto missing = [&](const std::string& text) {
    std::vector<std::string> result;
    for (const std::string& name : tests_named_in(text)) {
      if (!exists(known, name)) result.push_back(name);
    }
    return result;
  };
  BOOST_TEST(
      missing("`named_tests/missing_tests_are_seen`, `named_tests/…`, `build/vehd`, `conductance/area`").empty());
  BOOST_TEST(missing("`named_tests/tests_that_nobody_wrote`").size() == 1);
  BOOST_TEST(missing("`no_such_suite/…` and --run_test=named_tests,no_such_suite/every*").size() == 2);
  BOOST_TEST(missing("--run_test=named_tests/missing* and --run_test=named_tests/nothing*").size() == 1);
  BOOST_TEST(test_files_named_in("measured in tests/sphere/transform_test.cpp, tests/sphere").size() == 1);
}

BOOST_AUTO_TEST_SUITE_END()
