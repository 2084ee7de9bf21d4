#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cctype>
#include <sstream>

#include "tests/floors/source_files.hpp"

BOOST_AUTO_TEST_SUITE(words)

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sources_and_pages() {
  std::vector<fs::path> files = pages();
  for (const char* folder : {"bie", "fem_check", "meshes", "docs"}) {
    const std::vector<fs::path> more =
        files_below(folder, {".cpp", ".hpp", ".py", ".cmake", ".ipynb", ".sbatch", ".js", ".toml"});
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

// Readers stumbled over each of these.
BOOST_AUTO_TEST_CASE(phrases_that_readers_stumble_over_occur_nowhere) {
  const std::regex phrases(
      "(hear of each other|afresh|with the past|foretold|dearer|has learnt|gainless|roughest|hopeless|treads like|"
      "in somebody|\\bby place\\b)");
  const std::vector<fs::path> files = sources_and_pages();
  BOOST_TEST(files.size() > 500);
  for (const fs::path& file : files) {
    std::smatch phrase;
    const std::string text = lower_case(text_of(file));
    const bool occurs = std::regex_search(text, phrase, phrases);
    BOOST_TEST(!occurs, file.string() + ": " + phrase.str());
  }
}

// The reference of the keys is printed by the program.
BOOST_AUTO_TEST_CASE(pages_of_docs_are_short_and_state_measurements_of_committed_versions) {
  std::ptrdiff_t n_words = 0;
  for (const fs::path& page : files_below("docs", {".md"})) {
    const std::string text = text_of(page);
    std::istringstream stream(text);
    const std::ptrdiff_t n = std::distance(std::istream_iterator<std::string>(stream), {});
    BOOST_TEST((n <= 2500 || page.filename() == "scene_keys.md"), page.string() + ": " + std::to_string(n) + " words");
    BOOST_TEST(text.find("-dirty") == std::string::npos, page.string());
    n_words += n;
  }
  BOOST_TEST(n_words <= 60000);
}

BOOST_AUTO_TEST_CASE(headings_that_begin_with_what_are_questions) {
  for (const fs::path& page : pages()) {
    for (const std::string& heading : found(text_of(page), R"(\n#+ (What [^\n]*))")) {
      BOOST_TEST(heading.ends_with('?'), page.string() + ": " + heading);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
