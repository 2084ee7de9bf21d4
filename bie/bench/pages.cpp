#include "bie/bench/pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include "bie/support/child_process.hpp"
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

std::set<std::string> tables_in_pages(const std::filesystem::path& folder) {
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

namespace {

namespace fs = std::filesystem;

constexpr std::string_view hidden = "<!-- sh: ", end_of_hidden = " -->";

/// Creates links to the parts of the source tree that commands of the pages use.
void imitate_source_tree(const fs::path& folder, const fs::path& docs) {
  make_directory(folder / "build");
  fs::create_symlink(fs::read_symlink("/proc/self/exe"), folder / "build/vehd");
  fs::create_directory_symlink(docs, folder / "docs");
  const fs::path tests = docs.parent_path() / "tests";
  if (fs::is_directory(tests)) fs::create_directory_symlink(tests, folder / "tests");
}

/// The error of a command; empty if there is none.
std::string failure_of(const std::string& command, const fs::path& folder) {
  const fs::path messages = folder / "messages";
  const ChildEnd end = run_child({{"sh", "-c", command}, messages, folder});
  if (end.start_problem == 0 && end.signal == 0 && end.exit_code == 0) return {};
  return fmt::format("{}: {}", command, text_of_file(messages));
}

}  // namespace

std::vector<std::string> commands_of_page(const fs::path& page) {
  static const std::regex not_to_be_run("^(git |cmake |ctest |apt-get |dpkg |mpirun |out/(installed|package)/)");
  std::vector<std::string> commands;
  std::istringstream text(text_of_file(page));
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      inside = line == "```sh";
    } else if (inside && !line.empty() && !line.starts_with("#") && !std::regex_search(line, not_to_be_run)) {
      commands.push_back(line);
    } else if (!inside && line.starts_with(hidden) && line.ends_with(end_of_hidden)) {
      commands.push_back(line.substr(hidden.size(), line.size() - hidden.size() - end_of_hidden.size()));
    }
  }
  return commands;
}

std::vector<std::string> pictures_of(const std::vector<std::string>& commands) {
  static const std::regex picture("docs/(images/[^ ]+)");
  std::vector<std::string> pictures;
  for (const std::string& command : commands) {
    for (std::sregex_iterator match(command.begin(), command.end(), picture), end; match != end; ++match) {
      pictures.push_back((*match)[1]);
    }
  }
  return pictures;
}

std::vector<std::string> renew_pictures_of_pages(const fs::path& docs, BenchObserver& observer) {
  std::vector<std::string> unfinished;
  const fs::path source = fs::absolute(docs).lexically_normal();
  for (const fs::path& page : pages_of(source)) {
    const std::vector<std::string> commands = commands_of_page(page);
    const std::vector<std::string> pictures = pictures_of(commands);
    if (pictures.empty()) continue;
    const std::string name = page.lexically_relative(source).string();
    observer.note(fmt::format("{}: {} picture{}", name, pictures.size(), pictures.size() == 1 ? "" : "s"));
    const TemporaryFolder folder("vehd-page");
    imitate_source_tree(folder.path(), source);
    BenchTasks tasks(static_cast<int>(commands.size()), observer);
    for (const std::string& command : commands) {
      tasks.next(command);
      const std::string problem = failure_of(command, folder.path());
      if (problem.empty()) continue;
      observer.warn(fmt::format("{}: {}", name, problem));
      unfinished.push_back(name);
      break;
    }
  }
  return unfinished;
}

}  // namespace vehd
