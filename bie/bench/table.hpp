#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace vehd {

/// Statistics of the repeats of one timing.
struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
  std::int64_t repeats = 0;
};
/// @param values  at least one
Spread spread_of(std::vector<double> values);

/// Should a timing be repeated once more? Not after `repeats` of them, nor after 4 s in total, which are long enough.
bool wants_repeat(const std::vector<double>& seconds, int repeats);

/// Exponent b of y = a x^b, by least squares of the logarithms.
/// @param x, y  positive, at least two different x
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

/// Unknown, a name, a count, a number, or the repeats of a timing.
using BenchCell = std::variant<std::monostate, std::string, std::int64_t, double, Spread>;

/// One column of a table, and its names in files and in print.
struct BenchColumn {
  std::string key;      ///< in CSV and JSON
  std::string heading;  ///< on terminals and pages; empty: not shown there
  std::string format = "{:.3g}";
  bool timing = false;    ///< holds repeats
  std::size_t width = 9;  ///< least width on a terminal
};

/// Measurements of one bench in the order in which they were made. In CSV and JSON, repeats take four columns: the
/// median under KEY, and KEY_min, KEY_max, KEY_repeats.
struct BenchTable {
  std::string name;
  std::vector<BenchColumn> columns;
  std::vector<std::vector<BenchCell>> rows{};
};

/// The cell in a column, which must exist.
const BenchCell& cell_of(const BenchTable& table, std::size_t row, const std::string& key);

/// The table as CSV.
std::string csv_of(const BenchTable& table);
/// The rows as an array of objects.
nlohmann::ordered_json json_of(const BenchTable& table);
/// The table in Markdown, for a page.
std::string markdown_of(const BenchTable& table);

/// The headings as a line on a terminal; every row can be printed as soon as it is measured.
std::string heading_line(const BenchTable& table);
/// One row as a line on a terminal.
std::string row_line(const BenchTable& table, const std::vector<BenchCell>& row);

}  // namespace vehd
