#include <boost/test/unit_test.hpp>
#include <chrono>
#include <optional>

#include "bie/runs/run_loop.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(checkpoint_lag)

namespace {

vehd::Scene relaxing() {
  return vehd::parse_scene(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.4]\n[membrane]\nbending_modulus = 1.0\n"
      "[numerics]\ndegree = 8\ndt = 0.05\nend_time = 0.4\n[output]\nevery = 0.1\n",
      "scene.toml", ".");
}

struct Directory {
  TemporaryDirectory temporary;
  vehd::RunPaths paths{temporary / "run"};

  Directory() { vehd::make_directory(paths.directory); }
  [[nodiscard]] vehd::Checkpoint checkpoint() const { return vehd::read_checkpoint(paths.checkpoint()); }
};

/// Goes on for so many steps.
void go_on(vehd::RecordedRun& run, int n_steps) {
  run.start();
  for (; n_steps > 0; --n_steps) run.step();
}

}  // namespace

// Rows and snapshots that the checkpoint does not count are made again.
BOOST_AUTO_TEST_CASE(steps_behind_the_checkpoint_are_made_again) {
  const vehd::Scene scene = relaxing();
  constexpr int kAll = 8;
  const Directory whole, killed;
  const std::optional<vehd::Checkpoint> none;
  {
    vehd::RecordedRun run({scene, whole.paths, none});
    go_on(run, kAll);
    run.end({.completed = true, .reason = {}});
  }
  {
    vehd::RecordedRun run(
        {.scene = scene, .paths = killed.paths, .checkpoint = none, .checkpoint_lag = std::chrono::hours(1)});
    go_on(run, 5);
    BOOST_TEST(killed.checkpoint().n_rows == 1);
    BOOST_TEST(killed.checkpoint().n_snapshots == 1);
  }
  const std::optional<vehd::Checkpoint> left = killed.checkpoint();
  vehd::RecordedRun run({scene, killed.paths, left});
  go_on(run, kAll);
  run.end({.completed = true, .reason = {}});
  BOOST_TEST(file_text(killed.paths.history()) == file_text(whole.paths.history()));
  BOOST_TEST(killed.checkpoint().n_snapshots == 5);
  BOOST_TEST(killed.checkpoint().snapshots_checksum == whole.checkpoint().snapshots_checksum);
}

BOOST_AUTO_TEST_CASE(the_end_of_a_session_brings_the_checkpoint_up_to_date) {
  const vehd::Scene scene = relaxing();
  const Directory directory;
  const std::optional<vehd::Checkpoint> none;
  vehd::RecordedRun run(
      {.scene = scene, .paths = directory.paths, .checkpoint = none, .checkpoint_lag = std::chrono::hours(1)});
  go_on(run, 3);
  run.end({.completed = false, .reason = "a signal"});
  BOOST_TEST(directory.checkpoint().n_rows == 4);
  BOOST_TEST(directory.checkpoint().state.step == 3);
}

BOOST_AUTO_TEST_SUITE_END()
