#include "bie/bench/doc_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr const char* kBegin = "<!-- table ";
constexpr const char* kBeginEnd = " -->\n";
constexpr const char* kEnd = "<!-- end of table -->";

}  // namespace

std::vector<std::filesystem::path> pages_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> pages;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

int put_table(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
  int count = 0;
  const std::string begin = kBegin + name + kBeginEnd;
  for (const auto& page : pages_of(folder)) {
    const std::string before = text_of_file(page);
    std::string after = before;
    for (std::size_t at = after.find(begin); at != std::string::npos; at = after.find(begin, at + 1)) {
      const std::size_t first = at + begin.size();
      const std::size_t end = after.find(kEnd, first);
      if (end == std::string::npos || after.find(kBegin, first) < end) {
        throw InputError(fmt::format("{}: table \"{}\" has no line \"{}\"", page.string(), name, kEnd));
      }
      after.replace(first, end - first, text);
      ++count;
    }
    if (after != before) replace_file(page, after);
  }
  return count;
}

std::set<std::string> wanted_tables(const std::filesystem::path& folder) {
  std::set<std::string> names;
  const std::string begin = kBegin;
  for (const auto& page : pages_of(folder)) {
    const std::string text = text_of_file(page);
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
      const std::size_t first = at + begin.size();
      names.insert(text.substr(first, text.find(kBeginEnd, first) - first));
    }
  }
  return names;
}

bool pages_mention(const std::filesystem::path& folder, const std::string& text) {
  const std::vector<std::filesystem::path> pages = pages_of(folder);
  return std::any_of(pages.begin(), pages.end(),
                     [&](const auto& page) { return text_of_file(page).find(text) != std::string::npos; });
}

}  // namespace vehd
