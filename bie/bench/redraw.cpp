#include "bie/bench/redraw.hpp"

#include <fmt/format.h>

#include "bie/bench/benches.hpp"
#include "bie/bench/pages.hpp"
#include "bie/bench/panels.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

namespace fs = std::filesystem;

fs::path draw_record(const fs::path& csv) {
  const std::vector<BenchPanel> panels = panels_of(csv.stem().string(), BenchRecord(csv));
  if (panels.empty()) return {};
  const fs::path picture = fs::path(csv).replace_extension(".png");
  draw_bench(panels, picture);
  return picture;
}

std::vector<fs::path> redraw(const fs::path& folder, const fs::path& docs) {
  std::vector<fs::path> pictures;
  for (const fs::path& csv : files_ending(folder, ".csv")) {
    const fs::path picture = draw_record(csv);
    if (picture.empty()) continue;
    pictures.push_back(picture);
    const std::string name = "bench_" + picture.filename().string();
    if (docs.empty() || !pages_mention(docs, "images/" + name)) continue;
    pictures.push_back(docs / "images" / name);
    fs::copy_file(picture, pictures.back(), fs::copy_options::overwrite_existing);
  }
  const fs::path stability = folder / "stability", runs = stability / "runs";
  if (fs::is_directory(runs)) {
    for (const auto& entry : fs::directory_iterator(runs)) {
      pictures.push_back(draw_case({entry.path()}, stability / "shapes"));
      const fs::path shown = docs / "images/hard_cases" / pictures.back().filename();
      if (docs.empty() || !fs::exists(shown)) continue;
      fs::copy_file(pictures.back(), shown, fs::copy_options::overwrite_existing);
      pictures.push_back(shown);
    }
  }
  if (pictures.empty()) throw InputError(fmt::format("{}: has no table of a bench (NAME.csv)", folder.string()));
  return pictures;
}

}  // namespace vehd
