#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vehd {

/// Cells row by row, UTF-8; every row has the same number of cells.
using TextTable = std::vector<std::vector<std::string>>;

/// Columns that a text takes on a terminal: one per character, none for combining marks (U+0300 ... U+036F).
std::size_t display_width(const std::string& text);

/// Lines of aligned columns, two spaces apart; the last column is not padded.
std::string aligned(const TextTable& rows, const std::string& indent);

/// A Markdown table whose first row is the header and whose first column is code.
std::string markdown_table(const TextTable& rows);

}  // namespace vehd
