#pragma once

#include <string>
#include <utility>
#include <vector>

/// Lines of CSV files: cells between commas, quoted where they must be (RFC 4180).
namespace vehd {

/// One line with its end.
std::string csv_line(const std::vector<std::string>& cells);

/// Cells of a line of numbers and names, which hold no quotes. A carriage return at the end is left out.
std::vector<std::string> csv_cells(const std::string& line);

/// The number of a cell, NaN where it begins with none.
double number_of_cell(const std::string& cell);

/// Name and unit of a header "time [ms]"; the unit is empty where there is none.
std::pair<std::string, std::string> header_parts(const std::string& header);

/// Cells of a line as csv_line writes it: some are in quotes, which stand twice within them.
std::vector<std::string> quoted_csv_cells(const std::string& line);

}  // namespace vehd
