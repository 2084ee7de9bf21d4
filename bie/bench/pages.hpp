#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bie/bench/result.hpp"

namespace vehd {

/// The pages (Markdown) in a folder and below it, sorted.
std::vector<std::filesystem::path> pages_of(const std::filesystem::path& folder);

/// Replaces a table in the pages (.md) of a folder and its subfolders: the text between the lines "<!-- table NAME -->"
/// and "<!-- end of table -->", wherever these occur.
/// @return number of replacements
/// @throws InputError if a beginning has no end
int put_table(const std::filesystem::path& folder, const std::string& name, const std::string& text);

/// Names of all tables in the pages.
std::set<std::string> tables_in_pages(const std::filesystem::path& folder);

/// Does a page contain the text?
bool pages_mention(const std::filesystem::path& folder, const std::string& text);

/// Commands that a page (Markdown) shows to its reader, in order: the lines of its ```sh blocks, except those that
/// install, fetch or build. Those of its comments `<!-- sh: COMMAND -->`, each on a separate line, are in between:
/// readers do not see them, and they put pictures of the page into its folder of images.
std::vector<std::string> commands_of_page(const std::filesystem::path& page);

/// Pictures that these commands write into docs/images, by their names in pages ("images/NAME").
std::vector<std::string> pictures_of(const std::vector<std::string>& commands);

/// Runs the commands of all pages that write their own pictures, each page in a temporary folder that looks like the
/// source tree (build/vehd, docs, tests). A page ends with its first command that fails, which is reported.
/// @param docs  folder of the pages; its images are replaced
/// @return the pages that were not completed
std::vector<std::string> renew_pictures_of_pages(const std::filesystem::path& docs, BenchObserver& observer);

}  // namespace vehd
