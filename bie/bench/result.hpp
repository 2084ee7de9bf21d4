#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/bench/observer.hpp"
#include "bie/bench/table.hpp"
#include "bie/files/machine_record.hpp"

namespace vehd {

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

}  // namespace vehd
