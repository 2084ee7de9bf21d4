#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace vehd {

/// Repeats of one timing.
struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
  std::int64_t repeats = 0;
};
/// @param values  at least one
Spread spread_of(std::vector<double> values);

/// Whether a timing is to be repeated once more: not beyond the wanted number, and not where it has taken seconds
/// already, because it is long enough then.
bool wants_repeat(const std::vector<double>& seconds, int repeats);

/// Exponent b of y = a x^b, by least squares of the logarithms.
/// @param x, y  positive, at least two different x
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

/// Unknown, a name, a count, a number, or the repeats of a timing.
using BenchCell = std::variant<std::monostate, std::string, std::int64_t, double, Spread>;

/// One column of a table: its name in files and in print.
struct BenchColumn {
  std::string key;      ///< in CSV and JSON
  std::string heading;  ///< for people; empty: not shown to them
  std::string format = "{:.3g}";
  bool timing = false;    ///< holds repeats
  std::size_t width = 9;  ///< on a terminal, at least
};

/// Measurements of one bench in the order in which they were made. Repeats take four columns in CSV and JSON: median
/// under the key, and KEY_min, KEY_max, KEY_repeats.
struct BenchTable {
  std::string name;
  std::vector<BenchColumn> columns;
  std::vector<std::vector<BenchCell>> rows{};
};

/// The cell of a column, which the table has.
const BenchCell& cell_of(const BenchTable& table, std::size_t row, const std::string& key);

/// The table as CSV.
std::string csv_of(const BenchTable& table);
/// The rows as an array of objects.
nlohmann::ordered_json json_of(const BenchTable& table);
/// The table as a page shows it.
std::string markdown_of(const BenchTable& table);

/// Lines for a terminal; every row can be printed when it is there.
std::string heading_line(const BenchTable& table);
/// One row as a line on a terminal.
std::string row_line(const BenchTable& table, const std::vector<BenchCell>& row);

}  // namespace vehd
