#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

/// The files of the project as texts.

inline const std::filesystem::path source = VEHD_SOURCE_DIR;

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// First groups of all matches.
inline std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> result;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) result.push_back((*it)[1]);
  return result;
}

inline std::vector<std::filesystem::path> files_below(const std::string& folder, const std::set<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
    if (endings.contains(entry.path().extension().string())) files.push_back(entry.path());
  }
  return files;
}

/// Pages of docs/ and of the top folder.
inline std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> files = files_below("docs", {".md"});
  for (const auto& entry : std::filesystem::directory_iterator(source)) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  return files;
}
