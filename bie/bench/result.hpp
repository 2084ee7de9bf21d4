#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/bench/table.hpp"
#include "bie/runs/run_status.hpp"

namespace vehd {

/// Observer of a bench, called as soon as there is a result.
class BenchObserver {
 public:
  virtual ~BenchObserver() = default;

  /// One of several benches begins.
  virtual void section(const std::string& title) = 0;
  /// A line for people.
  virtual void note(const std::string& line) = 0;
  /// Something beside the numbers is missing.
  virtual void warn(const std::string& problem) = 0;
  /// A table begins.
  virtual void heading(const BenchTable& table) = 0;
  /// A row of the table is known.
  virtual void row(const BenchTable& table, const std::vector<BenchCell>& row) = 0;
  /// A task begins, the first with number 1.
  virtual void task(int number, int n_tasks, const std::string& what) = 0;
  /// A run within a task has taken a step.
  virtual void status(const RunStatus& status) = 0;
};

/// Counts the tasks of one bench.
class BenchTasks {
 public:
  BenchTasks(int n_tasks, BenchObserver& observer) : n_tasks_(n_tasks), observer_(observer) {}

  /// The next task begins.
  void next(const std::string& what) { observer_.task(++n_begun_, n_tasks_, what); }

 private:
  int n_tasks_;
  int n_begun_ = 0;
  BenchObserver& observer_;
};

/// Machine, compiler and commit of a timing.
struct MachineRecord {
  std::string processor;  ///< as the operating system names it
  unsigned hardware_threads = 0;
  int threads = 0;  ///< that this process uses
  std::string compiler, version, commit;
};
/// That of this process.
MachineRecord machine_record();
/// An object with the members as keys.
nlohmann::ordered_json json_of(const MachineRecord& machine);
/// One line for people.
std::string text_of(const MachineRecord& machine);

/// Where the files of a bench go.
struct BenchOutput {
  std::filesystem::path directory;
  bool plot = true;
};

/// Measurements of one bench.
struct BenchResult {
  std::string name;  ///< of its files
  MachineRecord machine;
  int repeats = 1;               ///< of each timing, at most
  nlohmann::ordered_json facts;  ///< further conditions of the numbers, by key
  std::vector<BenchTable> tables;
};

/// Adds a row and tells of it.
void add_row(BenchTable& table, std::vector<BenchCell> row, BenchObserver& observer);

/// Name of the files and of the table on a page of one of its tables: that of the bench for the first one, NAME_TABLE.
std::string name_of_table(const BenchResult& result, std::size_t table);

/// The whole as JSON: name, machine, repeats, facts, and the rows of every table under its name.
nlohmann::ordered_json json_of(const BenchResult& result);

/// Writes NAME.json, NAME.csv with the first table, NAME_TABLE.csv with each further one, and beside each of these its
/// picture, if there is one (panels_of); tells where. A picture that cannot be drawn is a warning.
/// @return json_of
/// @throws OutputError
nlohmann::ordered_json write_bench(const BenchResult& result, const BenchOutput& output, BenchObserver& observer);

/// Draws NAME.png beside NAME.csv, the table of an earlier bench.
/// @return the picture; empty where the bench has none
/// @throws InputError if the file cannot be read, or if gnuplot is missing or reports an error
std::filesystem::path draw_record(const std::filesystem::path& csv);

/// Draws the pictures of all benches whose tables are in a folder, of the hard cases whose runs are in its
/// stability/runs, and renews those that pages show.
/// @param docs  folder of the pages; empty: none
/// @return the pictures
/// @throws InputError if there is no table in the folder, and as draw_record
std::vector<std::filesystem::path> redraw(const std::filesystem::path& folder, const std::filesystem::path& docs);

}  // namespace vehd
