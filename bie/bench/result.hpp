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
  /// A line of text to print.
  virtual void note(const std::string& line) = 0;
  /// Something other than the numbers is missing.
  virtual void warn(const std::string& problem) = 0;
  /// A table begins.
  virtual void heading(const BenchTable& table) = 0;
  /// A row of the table has been measured.
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

  /// Reports that the next task begins.
  void next(const std::string& what) { observer_.task(++n_begun_, n_tasks_, what); }

 private:
  int n_tasks_;
  int n_begun_ = 0;
  BenchObserver& observer_;
};

/// Machine, compiler and commit of a timing.
struct MachineRecord {
  std::string processor;  ///< name given by the operating system
  unsigned hardware_threads = 0;
  int threads = 0;  ///< used by this process
  std::string compiler, version, commit;
};
/// The record of this process.
MachineRecord machine_record();
/// An object with the members as keys.
nlohmann::ordered_json json_of(const MachineRecord& machine);
/// One line of text.
std::string text_of(const MachineRecord& machine);

/// Destination of the files of a bench.
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

/// Adds a row and reports it.
void add_row(BenchTable& table, std::vector<BenchCell> row, BenchObserver& observer);

/// Name of a table, in files and on pages: that of the bench for the first table, NAME_TABLE for the others.
std::string name_of_table(const BenchResult& result, std::size_t table);

/// The result as JSON: name, machine, repeats, facts, and the rows of every table under its name.
nlohmann::ordered_json json_of(const BenchResult& result);

/// Writes NAME.json, NAME.csv with the first table, NAME_TABLE.csv with each further one, and beside each of these its
/// picture, if there is one (panels_of); reports the files. A picture that cannot be drawn is a warning.
/// @return json_of(result)
/// @throws OutputError
nlohmann::ordered_json write_bench(const BenchResult& result, const BenchOutput& output, BenchObserver& observer);

/// Draws NAME.png beside NAME.csv, the table of an earlier bench.
/// @return path of the picture; empty if the bench has none
/// @throws InputError if the file cannot be read, or if gnuplot is missing or reports an error
std::filesystem::path draw_record(const std::filesystem::path& csv);

/// Draws the pictures of all benches whose tables are in a folder and of the hard cases whose runs are in its
/// stability/runs, and replaces those that pages show.
/// @param docs  folder of the pages; empty: none
/// @return paths of the pictures
/// @throws InputError if there is no table in the folder, and errors of draw_record
std::vector<std::filesystem::path> redraw(const std::filesystem::path& folder, const std::filesystem::path& docs);

}  // namespace vehd
