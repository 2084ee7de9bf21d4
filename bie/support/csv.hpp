#pragma once

#include <string>
#include <utility>
#include <vector>

/// Lines of CSV files: cells between commas, quoted where they must be (RFC 4180).
namespace vehd {

/// One line, newline included.
std::string csv_line(const std::vector<std::string>& cells);

/// Cells of a line without quotes. Carriage returns are dropped.
std::vector<std::string> csv_cells(const std::string& line);

/// Number at the beginning of a cell, NaN if there is none.
double number_of_cell(const std::string& cell);

/// Name and unit of a header "time [ms]"; the unit is empty if there is none.
std::pair<std::string, std::string> header_parts(const std::string& header);

/// Cells of a line written by csv_line, with its quoting undone.
std::vector<std::string> quoted_csv_cells(const std::string& line);

}  // namespace vehd
