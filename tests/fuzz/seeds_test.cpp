#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>

#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/written_numbers.hpp"
#include "tests/support/files.hpp"

namespace {

std::vector<std::filesystem::path> seeds_of(std::string_view target) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(VEHD_SOURCE_DIR "/tests/fuzz/seeds") / target)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(seeds)

// Inputs that a fuzzer found interesting or that once broke a reader. CTest's time limit requires that each ends soon.
BOOST_AUTO_TEST_CASE(every_seed_is_read_or_refused_in_order) {
  for (const fuzz::Target& target : fuzz::targets) {
    const auto files = seeds_of(target.name);
    BOOST_TEST(files.size() >= 5U, target.name);
    for (const std::filesystem::path& file : files) {
      BOOST_TEST_CONTEXT(file) { BOOST_CHECK_NO_THROW(target.run(file_text(file))); }
    }
  }
}

// A comparison that accepts everything would find nothing.
BOOST_AUTO_TEST_CASE(numbers_that_were_read_wrongly_are_noticed) {
  int compared = 0;
  for (const std::filesystem::path& file : seeds_of("scene")) {
    const std::string text = file_text(file);
    std::optional<vehd::Scene> scene;
    try {
      scene = vehd::parse_scene(text, "scene.toml", "/nonexistent");
    } catch (const vehd::InputError&) {
      continue;
    }
    BOOST_TEST_CONTEXT(file) {
      BOOST_CHECK_NO_THROW(fuzz::require_written_numbers(text, *scene));
      scene->numerics.end_time = 1.5 * scene->numerics.end_time + 1.0;
      BOOST_CHECK_THROW(fuzz::require_written_numbers(text, *scene), std::logic_error);
    }
    ++compared;
  }
  BOOST_TEST(compared >= 4);
}

BOOST_AUTO_TEST_SUITE_END()
