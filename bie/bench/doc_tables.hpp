#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace vehd {

/// The pages (Markdown) in a folder and below it, in order.
std::vector<std::filesystem::path> pages_of(const std::filesystem::path& folder);

/// Puts a table into the pages (.md) of a folder and its subfolders: between the lines "<!-- table NAME -->" and
/// "<!-- end of table -->", wherever they stand.
/// @return number of places
/// @throws InputError where a beginning has no end
int put_table(const std::filesystem::path& folder, const std::string& name, const std::string& text);

/// Names of all tables that the pages ask for.
std::set<std::string> wanted_tables(const std::filesystem::path& folder);

/// Whether some page holds the text.
bool pages_mention(const std::filesystem::path& folder, const std::string& text);

}  // namespace vehd
