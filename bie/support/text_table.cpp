#include "bie/support/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vehd {
namespace {

/// An unescaped bar would end the cell.
std::string escaped(const std::string& cell) {
  std::string result;
  for (const char letter : cell) {
    if (letter == '|') result += '\\';
    result += letter;
  }
  return result;
}

}  // namespace

std::size_t display_width(const std::string& text) {
  std::size_t width = 0;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool continues = (byte & 0xC0U) == 0x80U;
    const bool combines = byte == 0xCCU || byte == 0xCDU;
    if (!continues && !combines) ++width;
  }
  return width;
}

std::string aligned(const TextTable& rows, const std::string& indent) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], display_width(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (i + 1 < row.size()) line += std::string(widths[i] + 2 - display_width(row[i]), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string markdown_table(const TextTable& rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t column = 0; column < rows[i].size(); ++column) {
      const bool code = i > 0 && column == 0;
      text += fmt::format("| {0}{1}{0} ", code ? "`" : "", escaped(rows[i][column]));
    }
    text += "|\n";
    if (i > 0) continue;
    for (std::size_t column = 0; column < rows[i].size(); ++column) text += "| --- ";
    text += "|\n";
  }
  return text;
}

}  // namespace vehd
