#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bie/support/file_system.hpp"

/// Temporary directory for one test case, removed at the end.
class TemporaryDirectory {
 public:
  [[nodiscard]] std::string operator/(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  vehd::TemporaryFolder folder_{"vehd-test"};
};

inline std::string file_text(const std::filesystem::path& path) { return vehd::text_of_file(path); }

inline nlohmann::json json_of(const std::filesystem::path& path) { return nlohmann::json::parse(file_text(path)); }

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}
