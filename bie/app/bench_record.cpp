#include "bie/app/bench_record.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "bie/app/versions.hpp"

namespace vehd {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  }
  return "unknown";
}

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

/// Empty without git or outside a work tree.
std::string commit() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const std::string command =
      "git -C " + shell_quoted(self.parent_path().string()) + " describe --always --dirty --exclude '*' 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::array<char, 128> line{};
  if (!pipe || std::fgets(line.data(), line.size(), pipe.get()) == nullptr) return {};
  std::string text = line.data();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

nlohmann::json machine_record() {
  nlohmann::json record = {{"processor", processor()},
                           {"hardware_threads", std::thread::hardware_concurrency()},
                           {"compiler", library_versions().at("compiler")},
                           {"version", program_version()}};
  if (const std::string name = commit(); !name.empty()) record["commit"] = name;
  return record;
}

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  return {median, values.front(), values.back()};
}

}  // namespace vehd
