#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cctype>
#include <map>
#include <sstream>

#include "tests/floors/source_files.hpp"

BOOST_AUTO_TEST_SUITE(links)

namespace {

namespace fs = std::filesystem;

/// A page without blocks of code and without inline code, in which brackets are no links.
std::string prose_of(const std::string& page) {
  std::istringstream lines(page);
  std::string prose;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
    } else if (!inside) {
      prose += line + "\n";
    }
  }
  return std::regex_replace(prose, std::regex("`[^`]*`"), "");
}

/// Targets of the links and pictures of a page, without web addresses.
std::vector<std::string> links_in(const std::string& page) {
  const std::string prose = prose_of(page);
  std::vector<std::string> targets = found(prose, R"(\]\(([^)\s]+)[^)]*\))");
  for (const char* pattern : {R"((?:^|\n)\[[^\]\n]+\]:\s*(\S+))", R"re((?:src|href)="([^"]+)")re"}) {
    const std::vector<std::string> more = found(prose, pattern);
    targets.insert(targets.end(), more.begin(), more.end());
  }
  std::erase_if(targets, [](const std::string& target) { return std::regex_search(target, std::regex("^[a-z]+:")); });
  return targets;
}

/// Files and folders of the project that a page names as code, with their paths from the top folder.
std::vector<std::string> paths_named_in(const std::string& page) {
  return found(page, R"(`((?:bie|docs|fem_check|meshes|tests)/[\w/.-]*(?:\.[a-z]+|/))`)");
}

/// Anchor that GitHub and Sphinx make from a heading: lower case, spaces as hyphens, no punctuation. Non-ASCII
/// characters of two bytes are letters and stay (é, κ); longer ones are symbols in these pages.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (std::size_t i = 0; i < heading.size();) {
    const auto c = static_cast<unsigned char>(heading[i]);
    const std::size_t length = c < 0x80 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;
    if (length == 1) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(c) != 0 || c == '-' || c == '_') anchor += static_cast<char>(std::tolower(c));
    } else if (length == 2 && c >= 0xc3) {
      anchor += heading.substr(i, length);
    }
    i += length;
  }
  return anchor;
}

std::set<std::string> anchors_in(const std::string& page) {
  std::istringstream lines(page);
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) inside = !inside;
    std::smatch match;
    if (inside || !std::regex_match(line, match, std::regex("#{1,6} +(.*?) *"))) continue;
    const std::string anchor = anchor_of(match[1]);
    const int n = seen[anchor]++;
    anchors.insert(n == 0 ? anchor : anchor + "-" + std::to_string(n));
  }
  return anchors;
}

/// Why a link of a page is broken; empty if it is not.
std::string trouble_with(const std::string& link, const fs::path& page) {
  const std::size_t sharp = link.find('#');
  const std::string path = link.substr(0, sharp);
  const fs::path target = path.empty() ? page : page.parent_path() / path;
  if (!fs::exists(target)) return "no such file";
  if (fs::relative(fs::weakly_canonical(target), fs::weakly_canonical(source)).string().starts_with(".."))
    return "outside of the project";
  if (sharp == std::string::npos) return "";
  return anchors_in(text_of(target)).contains(link.substr(sharp + 1)) ? "" : "no such heading";
}

/// Keys of the references: their headings that end with a year.
std::vector<std::string> reference_keys() {
  return found(text_of(source / "docs/references.md"), R"(\n### ([^\n]* (?:19|20)\d\d)\n)");
}

/// Every "Somebody 1234" that a docstring names after "Source:", with all the text before it.
std::vector<std::string> sources_named_in(const std::string& code) {
  std::vector<std::string> named;
  for (std::string text : found(code, R"(/// Source: ([^\n]*(?:\n *///  *(?!@|Accuracy:)[^\n]*)*))")) {
    text = std::regex_replace(text, std::regex(R"(\n *///  *)"), " ");
    const std::regex year(R"(\b(?:19|20)\d\d\b)");
    for (std::sregex_iterator it(text.begin(), text.end(), year), end; it != end; ++it) {
      named.push_back(text.substr(0, static_cast<std::size_t>(it->position() + it->length())));
    }
  }
  return named;
}

bool is_known(const std::string& named, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return named.ends_with(key); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_link_of_every_page_leads_somewhere) {
  std::size_t n_links = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& link : links_in(text_of(page))) {
      const std::string trouble = trouble_with(link, page);
      BOOST_TEST(trouble.empty(), page.string() + ": " + link + ": " + trouble);
      ++n_links;
    }
  }
  BOOST_TEST(n_links > 100);
}

BOOST_AUTO_TEST_CASE(every_file_and_folder_that_a_page_names_exists) {
  std::size_t n_named = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& path : paths_named_in(text_of(page))) {
      BOOST_TEST(fs::exists(source / path), page.string() + ": " + path);
      ++n_named;
    }
  }
  BOOST_TEST(n_named > 50);
}

BOOST_AUTO_TEST_CASE(every_source_of_a_docstring_stands_in_the_references) {
  const std::vector<std::string> keys = reference_keys();
  BOOST_TEST(keys.size() > 10);
  std::size_t n_named = 0;
  for (const char* folder : {"bie", "fem_check", "meshes"}) {
    for (const fs::path& file : files_below(folder, {".hpp", ".cpp"})) {
      for (const std::string& named : sources_named_in(text_of(file))) {
        BOOST_TEST(is_known(named, keys), file.string() + ": " + named);
        ++n_named;
      }
    }
  }
  BOOST_TEST(n_named > 10);
}

BOOST_AUTO_TEST_CASE(links_that_lead_nowhere_are_seen) {
  const fs::path page = source / "docs/theory/time.md";
  BOOST_TEST(trouble_with("../conventions.md#potentials", page).empty());
  BOOST_TEST(trouble_with("#the-potential", page).empty());
  BOOST_TEST(trouble_with("../images/figure2_shapes.png", page).empty());
  BOOST_TEST(trouble_with("conventions.md", page) == "no such file");
  BOOST_TEST(trouble_with("../conventions.md#potential-and-pressure", page) == "no such heading");
  BOOST_TEST(trouble_with("../../../", page) == "outside of the project");
  BOOST_TEST(paths_named_in("`bie/a/b.hpp`, `tests/hard/`, `bie/setup`, `SUITE/case`, bie/c.cpp").size() == 2);
  const std::vector<std::string> expected = {"a.md", "b.png", "c.md"};
  BOOST_TEST(
      links_in("[a](a.md) `[x](x.md)`\n```\n[y](y.md)\n```\n![b](b.png \"title\") [w](https://w.org)\n[c]: c.md\n") ==
          expected,
      boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(anchors_are_those_of_github) {
  BOOST_TEST(anchor_of("D′ without a singular integral") == "d-without-a-singular-integral");
  BOOST_TEST(anchor_of("The equation for V_m") == "the-equation-for-v_m");
  BOOST_TEST(anchor_of("1 · How far? — `Evolution::step`") == "1--how-far--evolutionstep");
  const std::set<std::string> expected = {"again", "again-1"};
  BOOST_TEST(anchors_in("# Again\n```\n# code\n```\n## Again\n") == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(unknown_sources_are_seen) {
  const std::vector<std::string> keys = {"Helfrich 1973"};
  const std::vector<std::string> named = sources_named_in(
      "/// Source: paper Eq. (2); Helfrich 1973\n\n  /// Source: as nobody in\n  /// particular 1850, 1950\n");
  BOOST_REQUIRE(named.size() == 2);
  BOOST_TEST(is_known(named[0], keys));
  BOOST_TEST(!is_known(named[1], keys));
}

BOOST_AUTO_TEST_SUITE_END()
