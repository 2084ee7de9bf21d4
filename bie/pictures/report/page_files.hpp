#pragma once

#include <string_view>

namespace vehd {

/// The sources of a report's page, bie/pictures/report/page, as the build has put them into the program.
struct PageFiles {
  std::string_view page;    ///< HTML with places {{title}}, {{style}}, {{script}} and {{data}}
  std::string_view style;   ///< all CSS
  std::string_view script;  ///< all JavaScript
};

/// Defined by a file that bie/cmake/report_page.cmake writes.
PageFiles page_files();

}  // namespace vehd
