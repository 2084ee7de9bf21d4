#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/bench/observer.hpp"

namespace vehd {

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
