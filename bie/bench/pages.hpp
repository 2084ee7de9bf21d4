#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bie/bench/result.hpp"

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

/// Commands that a page (Markdown) tells its reader to type, in their order: the lines of its ```sh blocks, but for
/// those that install, fetch or build. Between them are those of its comments `<!-- sh: COMMAND -->`, each a line of
/// its own, which readers do not see: they put pictures of the page into its folder of images.
std::vector<std::string> commands_of_page(const std::filesystem::path& page);

/// The pictures that these commands write into docs/images, as pages name them ("images/NAME").
std::vector<std::string> pictures_of(const std::vector<std::string>& commands);

/// Runs the commands of all pages that write pictures of their own, each page in a folder of its own that looks like
/// the source tree (build/vehd, docs, tests) and is gone afterwards. A page ends with its first command that fails,
/// which is told.
/// @param docs  folder of the pages; its images are replaced
/// @return the pages that did not come to their end
std::vector<std::string> renew_pictures_of_pages(const std::filesystem::path& docs, BenchObserver& observer);

}  // namespace vehd
