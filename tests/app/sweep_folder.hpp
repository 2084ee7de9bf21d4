#pragma once

#include <sys/stat.h>

#include <set>
#include <sstream>

#include "bie/support/csv.hpp"
#include "tests/app/program.hpp"

/// A folder with a quick scene, sweeps of it and their results.
struct SweepWork {
  TemporaryDirectory directory;
  std::string file = directory / "some.toml", output = directory / "out";

  explicit SweepWork(const std::string& scene = quick_scene("0.5")) { write_text(directory / "base.toml", scene); }

  /// @param keys  lines of [vary]
  void write_sweep(const std::string& keys, const std::string& more = "") const {
    write_text(file, "scene = \"base.toml\"\n" + more + "[vary]\n" + keys);
  }
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more = {},
                                                 const std::string& place = "") const {
    std::vector<std::string> words = {"sweep", file, "-o", place.empty() ? output : place, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return vehd_command(words);
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more = {}, const std::string& place = "") const {
    return run_command(command(more, place));
  }

  /// Rows of the table without the seconds, the header first.
  [[nodiscard]] std::vector<std::vector<std::string>> table(const std::string& place = "") const {
    std::istringstream text(file_text((place.empty() ? output : place) + "/table.csv"));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(text, line);) {
      rows.push_back(vehd::csv_cells(line));
      rows.back().erase(rows.back().end() - 2);
    }
    return rows;
  }
  /// Cells of a column.
  [[nodiscard]] std::vector<std::string> column(const std::string& name) const {
    const auto rows = table();
    std::vector<std::string> cells;
    const auto at = std::find(rows.front().begin(), rows.front().end(), name) - rows.front().begin();
    for (std::size_t row = 1; row < rows.size(); ++row) cells.push_back(rows[row].at(static_cast<std::size_t>(at)));
    return cells;
  }

  /// Processes that hold the locks of run directories.
  [[nodiscard]] std::vector<pid_t> workers() const {
    std::set<std::string> locks;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(output + "/runs", ignored)) {
      struct stat facts {};
      if (::stat((entry.path() / ".lock").c_str(), &facts) == 0) locks.insert(std::to_string(facts.st_ino));
    }
    // A line of the table: "1: FLOCK  ADVISORY  WRITE 6679 fe:00:10953314 0 EOF"
    std::vector<pid_t> workers;
    std::istringstream table(file_text("/proc/locks"));
    for (std::string line; std::getline(table, line);) {
      std::istringstream words(line);
      std::string number, kind, advisory, access, inode;
      pid_t process = 0;
      words >> number >> kind >> advisory >> access >> process >> inode;
      if (kind == "FLOCK" && locks.contains(inode.substr(inode.rfind(':') + 1))) workers.push_back(process);
    }
    return workers;
  }
};
